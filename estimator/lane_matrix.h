#pragma once

#include <Eigen/Core>

#include "reckon/estimator/lane.h"

namespace reckon::estimator {

inline Lane ToLane(const Eigen::Vector3d& v) { return Lane::Load(v.data()); }
inline Eigen::Vector3d ToEigen(Lane v) {
  Eigen::Vector3d result;
  v.Store(result.data());
  return result;
}

/// A 3×3 matrix, column by column in lanes: the unit in which a covariance is kept and worked on.
/// Nothing here allocates.
struct LaneMatrix {
  Lane column[3];

  static LaneMatrix Zero() { return {{Lane::Zero(), Lane::Zero(), Lane::Zero()}}; }
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
inline LaneMatrix Transposed(LaneMatrix A) {
  Lane::Transpose(A.column[0], A.column[1], A.column[2]);
  return A;
}

/// A with its lower triangle mirrored into the upper.
inline LaneMatrix Symmetric(const LaneMatrix& A) {
  const auto [a, b, c] = A.column;
  return {{a, {a[1], b[1], b[2]}, {a[2], b[2], c[2]}}};
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

inline LaneMatrix operator-(LaneMatrix A) {
  for (Lane& column : A.column) column = -column;
  return A;
}

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
/// A [v]×ᵀ.
inline LaneMatrix TimesTransposed(const LaneMatrix& A, const CrossProduct& cross) {
  const auto [a, b, c] = A.column;
  const Lane x = Lane::All(cross.v[0]), y = Lane::All(cross.v[1]), z = Lane::All(cross.v[2]);
  return {{y * c - z * b, z * a - x * c, x * b - y * a}};
}

/// A s.
inline LaneMatrix TimesTransposed(const LaneMatrix& A, double s) { return s * A; }

/// What the above are of a measurement of one row, where a matrix beside it shrinks to a number and
/// a strip to a vector: one text serves both.
inline Lane operator*(Lane a, double s) { return s * a; }
inline Lane TimesTransposed(const LaneMatrix& A, Lane row) { return A * row; }
inline double Symmetric(double s) { return s; }
inline double Dot(double a, double b) { return a * b; }
inline Eigen::Matrix<double, 1, 1> ToEigen(double s) { return Eigen::Matrix<double, 1, 1>(s); }

/// d I + [v]×.
inline LaneMatrix DiagonalAndCross(double d, Lane v) {
  return {{{d, v[2], -v[1]}, {-v[2], d, v[0]}, {v[1], -v[0], d}}};
}

inline LaneMatrix ToLanes(const Eigen::Matrix3d& M) {
  return {{Lane::Load(M.data()), Lane::Load(M.data() + 3), Lane::Load(M.data() + 6)}};
}
inline Eigen::Matrix3d ToEigen(const LaneMatrix& A) {
  Eigen::Matrix3d M;
  for (int j = 0; j < 3; ++j) A.column[j].Store(M.data() + 3 * j);
  return M;
}

}  // namespace reckon::estimator
