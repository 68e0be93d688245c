#pragma once

#include "reckon/estimator/lane_matrix.h"

namespace reckon::estimator {

/// The right factor B of many products A Bᵀ, whose entries are read as lanes that hold nothing
/// else. With wide registers those are made once; narrow ones would only be spilled, and make them
/// anew.
class SpreadMatrix {
 public:
#if RECKON_AVX2_LANES
  [[gnu::always_inline]] explicit SpreadMatrix(const LaneMatrix& B) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) entry_[i][j] = Lane::All(B(i, j));
    }
  }
  Lane entry(int i, int j) const { return entry_[i][j]; }

 private:
  Lane entry_[3][3];
#else
  explicit SpreadMatrix(const LaneMatrix& B) : B_(B) {}
  Lane entry(int i, int j) const { return Lane::All(B_(i, j)); }

 private:
  LaneMatrix B_;
#endif
};

/// A vector and a number likewise: what a measurement of one row has in a matrix's place.
struct SpreadLane {
  Lane entry[3];
};
struct SpreadNumber {
  Lane entry;
};

[[gnu::always_inline]] inline SpreadMatrix Spread(const LaneMatrix& B) { return SpreadMatrix(B); }
[[gnu::always_inline]] inline SpreadLane Spread(Lane b) {
  return {{Lane::All(b[0]), Lane::All(b[1]), Lane::All(b[2])}};
}
[[gnu::always_inline]] inline SpreadNumber Spread(double s) { return {Lane::All(s)}; }

/// A Bᵀ, A b and a s.
[[gnu::always_inline]] inline LaneMatrix TimesTransposed(const LaneMatrix& A,
                                                         const SpreadMatrix& B) {
  LaneMatrix C;
  for (int j = 0; j < 3; ++j) {
    C.column[j] = Combined(A, B.entry(j, 0), B.entry(j, 1), B.entry(j, 2));
  }
  return C;
}
[[gnu::always_inline]] inline Lane TimesTransposed(const LaneMatrix& A, const SpreadLane& b) {
  return Combined(A, b.entry[0], b.entry[1], b.entry[2]);
}
[[gnu::always_inline]] inline Lane TimesTransposed(Lane a, const SpreadNumber& s) {
  return a * s.entry;
}

/// C − A Bᵀ, C − a bᵀ and c − a s.
[[gnu::always_inline]] inline LaneMatrix Less(LaneMatrix C, const LaneMatrix& A,
                                              const SpreadMatrix& B) {
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) C.column[j].SubtractProduct(A.column[k], B.entry(j, k));
  }
  return C;
}
[[gnu::always_inline]] inline LaneMatrix Less(LaneMatrix C, Lane a, const SpreadLane& b) {
  for (int j = 0; j < 3; ++j) C.column[j].SubtractProduct(a, b.entry[j]);
  return C;
}
[[gnu::always_inline]] inline Lane Less(Lane c, Lane a, const SpreadNumber& s) {
  return c.SubtractProduct(a, s.entry);
}

/// What matrices can do, of a number.
[[gnu::always_inline]] inline Lane operator*(Lane a, double s) { return s * a; }
[[gnu::always_inline]] inline double Symmetric(double s) { return s; }
[[gnu::always_inline]] inline double Dot(double a, double b) { return a * b; }
inline Eigen::Matrix<double, 1, 1> ToEigen(double s) { return Eigen::Matrix<double, 1, 1>(s); }

}  // namespace reckon::estimator
