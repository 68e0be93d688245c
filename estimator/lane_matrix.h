#pragma once

#include <Eigen/Core>

#include "reckon/estimator/lane.h"

namespace reckon::estimator {

inline Lane ToLane(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d ToEigen(Lane v) { return {v[0], v[1], v[2]}; }

/// A 3×3 matrix, column by column in lanes: the unit in which a covariance is kept and worked on.
/// Nothing here allocates.
struct LaneMatrix {
  Lane column[3];

  static LaneMatrix Zero() { return Diagonal(0.0); }
  static LaneMatrix Diagonal(double s) { return {{{s, 0, 0}, {0, s, 0}, {0, 0, s}}}; }

  double operator()(int i, int j) const { return column[j][i]; }

  LaneMatrix& operator+=(const LaneMatrix& B) {
    for (int j = 0; j < 3; ++j) column[j] += B.column[j];
    return *this;
  }
  LaneMatrix& operator-=(const LaneMatrix& B) {
    for (int j = 0; j < 3; ++j) column[j] -= B.column[j];
    return *this;
  }
};

inline LaneMatrix operator+(LaneMatrix A, const LaneMatrix& B) { return A += B; }
inline LaneMatrix operator-(LaneMatrix A, const LaneMatrix& B) { return A -= B; }
inline LaneMatrix operator*(double s, LaneMatrix A) {
  for (Lane& column : A.column) column *= Lane::All(s);
  return A;
}

/// A v.
inline Lane operator*(const LaneMatrix& A, Lane v) {
  return v[0] * A.column[0] + v[1] * A.column[1] + v[2] * A.column[2];
}

/// A B.
inline LaneMatrix operator*(const LaneMatrix& A, const LaneMatrix& B) {
  return {{A * B.column[0], A * B.column[1], A * B.column[2]}};
}

/// Aᵀ.
inline LaneMatrix Transposed(const LaneMatrix& A) {
  return {{{A(0, 0), A(0, 1), A(0, 2)}, {A(1, 0), A(1, 1), A(1, 2)}, {A(2, 0), A(2, 1), A(2, 2)}}};
}

/// A Bᵀ.
inline LaneMatrix TimesTransposed(const LaneMatrix& A, const LaneMatrix& B) {
  LaneMatrix C;
  for (int j = 0; j < 3; ++j) {
    C.column[j] = B(j, 0) * A.column[0] + B(j, 1) * A.column[1] + B(j, 2) * A.column[2];
  }
  return C;
}

/// C += A Bᵀ.
inline void AddTimesTransposed(LaneMatrix& C, const LaneMatrix& A, const LaneMatrix& B) {
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) C.column[j] += B(j, k) * A.column[k];
  }
}

/// C −= A Bᵀ.
inline void SubtractTimesTransposed(LaneMatrix& C, const LaneMatrix& A, const LaneMatrix& B) {
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) C.column[j] -= B(j, k) * A.column[k];
  }
}

/// a bᵀ.
inline LaneMatrix TimesTransposed(Lane a, Lane b) { return {{b[0] * a, b[1] * a, b[2] * a}}; }

/// C −= a bᵀ.
inline void SubtractTimesTransposed(LaneMatrix& C, Lane a, Lane b) { C -= TimesTransposed(a, b); }

/// [v]× A.
inline LaneMatrix Cross(Lane v, const LaneMatrix& A) {
  return {{Cross(v, A.column[0]), Cross(v, A.column[1]), Cross(v, A.column[2])}};
}

/// [v]× as a factor.
struct CrossProduct {
  Lane v;
};
inline LaneMatrix operator*(const CrossProduct& cross, const LaneMatrix& A) {
  return Cross(cross.v, A);
}

inline LaneMatrix ToLanes(const Eigen::Matrix3d& M) {
  return {{{M(0, 0), M(1, 0), M(2, 0)}, {M(0, 1), M(1, 1), M(2, 1)}, {M(0, 2), M(1, 2), M(2, 2)}}};
}
inline Eigen::Matrix3d ToEigen(const LaneMatrix& A) {
  Eigen::Matrix3d M;
  for (int j = 0; j < 3; ++j) M.col(j) = ToEigen(A.column[j]);
  return M;
}

}  // namespace reckon::estimator
