#pragma once

#include <Eigen/Core>

#include "reckon/estimator/lane.h"

namespace reckon::estimator {

[[gnu::always_inline]] inline Lane ToLane(const Eigen::Vector3d& v) { return Lane::Load(v.data()); }
inline Eigen::Vector3d ToEigen(Lane v) {
  Eigen::Vector3d result;
  v.Store(result.data());
  return result;
}

/// A 3×3 matrix, column by column in lanes: the unit in which a covariance is kept and worked on.
/// Nothing here allocates.
struct LaneMatrix {
  Lane column[3];

  LaneMatrix() = default;
  LaneMatrix(Lane x, Lane y, Lane z) : column{x, y, z} {}
  // Lane by lane: compilers copy an array, or a loop over one, as bytes and through memory.
  LaneMatrix(const LaneMatrix& B) : column{B.column[0], B.column[1], B.column[2]} {}
  // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): all is read before any is written
  LaneMatrix& operator=(const LaneMatrix& B) {
    const Lane x = B.column[0], y = B.column[1], z = B.column[2];
    column[0] = x;
    column[1] = y;
    column[2] = z;
    return *this;
  }

  static LaneMatrix Zero() { return {Lane::Zero(), Lane::Zero(), Lane::Zero()}; }
  static LaneMatrix Diagonal(double s) { return {{s, 0, 0}, {0, s, 0}, {0, 0, s}}; }

  double operator()(int i, int j) const { return column[j][i]; }

  [[gnu::always_inline]] LaneMatrix& operator+=(const LaneMatrix& B) {
    for (int j = 0; j < 3; ++j) column[j] += B.column[j];
    return *this;
  }
  [[gnu::always_inline]] LaneMatrix& operator-=(const LaneMatrix& B) {
    for (int j = 0; j < 3; ++j) column[j] -= B.column[j];
    return *this;
  }
};

[[gnu::always_inline]] inline LaneMatrix operator+(LaneMatrix A, const LaneMatrix& B) {
  return A += B;
}
[[gnu::always_inline]] inline LaneMatrix operator-(LaneMatrix A, const LaneMatrix& B) {
  return A -= B;
}
[[gnu::always_inline]] inline LaneMatrix operator*(double s, LaneMatrix A) {
  for (Lane& column : A.column) column *= Lane::All(s);
  return A;
}

/// a x + b y + c z, element by element.
[[gnu::always_inline]] inline Lane Combined(const LaneMatrix& A, Lane x, Lane y, Lane z) {
  return (A.column[0] * x).AddProduct(A.column[1], y).AddProduct(A.column[2], z);
}

/// A v.
[[gnu::always_inline]] inline Lane operator*(const LaneMatrix& A, Lane v) {
  return Combined(A, Lane::All(v[0]), Lane::All(v[1]), Lane::All(v[2]));
}

/// A B.
[[gnu::always_inline]] inline LaneMatrix operator*(const LaneMatrix& A, const LaneMatrix& B) {
  return {A * B.column[0], A * B.column[1], A * B.column[2]};
}

/// Aᵀ.
[[gnu::always_inline]] inline LaneMatrix Transposed(LaneMatrix A) {
  Lane::Transpose(A.column[0], A.column[1], A.column[2]);
  return A;
}

/// A with its lower triangle mirrored into the upper.
[[gnu::always_inline]] inline LaneMatrix Symmetric(LaneMatrix A) {
  Lane::Mirror(A.column[0], A.column[1], A.column[2]);
  return A;
}

/// A Bᵀ.
[[gnu::always_inline]] inline LaneMatrix TimesTransposed(const LaneMatrix& A, const LaneMatrix& B) {
  LaneMatrix C;
  for (int j = 0; j < 3; ++j) {
    C.column[j] = Combined(A, Lane::All(B(j, 0)), Lane::All(B(j, 1)), Lane::All(B(j, 2)));
  }
  return C;
}

/// C += A Bᵀ. Summed beside C, column by column: C might be A or B as far as a compiler can tell.
[[gnu::always_inline]] inline void AddTimesTransposed(LaneMatrix& C, const LaneMatrix& A,
                                                      const LaneMatrix& B) {
  for (int j = 0; j < 3; ++j) {
    Lane sum = C.column[j];
    for (int k = 0; k < 3; ++k) sum.AddProduct(A.column[k], Lane::All(B(j, k)));
    C.column[j] = sum;
  }
}

/// a bᵀ.
[[gnu::always_inline]] inline LaneMatrix Outer(Lane a, Lane b) {
  return {b[0] * a, b[1] * a, b[2] * a};
}

[[gnu::always_inline]] inline LaneMatrix operator-(LaneMatrix A) {
  for (Lane& column : A.column) column = -column;
  return A;
}

/// [v]× A.
[[gnu::always_inline]] inline LaneMatrix Cross(Lane v, const LaneMatrix& A) {
  return {Cross(v, A.column[0]), Cross(v, A.column[1]), Cross(v, A.column[2])};
}

/// [v]× as a factor.
struct CrossProduct {
  Lane v;
};
[[gnu::always_inline]] inline LaneMatrix operator*(const CrossProduct& cross, const LaneMatrix& A) {
  return Cross(cross.v, A);
}
/// A [v]×ᵀ.
[[gnu::always_inline]] inline LaneMatrix TimesTransposed(const LaneMatrix& A,
                                                         const CrossProduct& cross) {
  const Lane a = A.column[0], b = A.column[1], c = A.column[2];
  const Lane x = Lane::All(cross.v[0]), y = Lane::All(cross.v[1]), z = Lane::All(cross.v[2]);
  return {y * c - z * b, z * a - x * c, x * b - y * a};
}

/// A s.
[[gnu::always_inline]] inline LaneMatrix TimesTransposed(const LaneMatrix& A, double s) {
  return s * A;
}

/// d I + [v]×.
[[gnu::always_inline]] inline LaneMatrix DiagonalAndCross(double d, Lane v) {
  LaneMatrix A;
  Lane::DiagonalAndCross(d, v, A.column[0], A.column[1], A.column[2]);
  return A;
}

[[gnu::always_inline]] inline LaneMatrix ToLanes(const Eigen::Matrix3d& M) {
  return {Lane::Load(M.data()), Lane::Load(M.data() + 3), Lane::Load(M.data() + 6)};
}
[[gnu::always_inline]] inline void Store(const LaneMatrix& A, Eigen::Matrix3d& M) {
  A.column[0].StoreFour(M.data());
  A.column[1].StoreFour(M.data() + 3);
  A.column[2].Store(M.data() + 6);
}
inline Eigen::Matrix3d ToEigen(const LaneMatrix& A) {
  Eigen::Matrix3d M;
  Store(A, M);
  return M;
}

}  // namespace reckon::estimator
