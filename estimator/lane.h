#pragma once

// An installed library says which lanes it was built with: its users must have the same.
#if !defined(RECKON_AVX_LANES)
#if defined(__AVX__)
#define RECKON_AVX_LANES 1
#else
#define RECKON_AVX_LANES 0
#endif
#elif RECKON_AVX_LANES && !defined(__AVX__)
#error "reckon was built with AVX, so this must be too (-mavx or -march)"
#endif

namespace reckon::estimator {

/// Four doubles that move together: a 3-vector and a padding number that nobody reads. One AVX
/// register where the compiler may use those, otherwise two of SSE: a 32-byte vector on plain
/// x86-64 is several times slower than that. The arithmetic is the same either way but for fused
/// multiply-adds.
class Lane {
 public:
  Lane() = default;
  Lane(double x, double y, double z) : Lane(x, y, z, 0.0) {}
  static Lane All(double s) { return {s, s, s, s}; }

#if RECKON_AVX_LANES
  double operator[](int i) const { return v_[i]; }

  Lane& operator+=(Lane b) { return v_ += b.v_, *this; }
  Lane& operator-=(Lane b) { return v_ -= b.v_, *this; }
  Lane& operator*=(Lane b) { return v_ *= b.v_, *this; }

 private:
  using Four = double __attribute__((vector_size(32)));
  Lane(double x, double y, double z, double w) : v_{x, y, z, w} {}
  Four v_;

 public:
  /// (y, z, x).
  Lane Rotated() const {
    Lane r;
#if defined(__clang__)
    r.v_ = __builtin_shufflevector(v_, v_, 1, 2, 0, 3);
#else
    using Places = long long __attribute__((vector_size(32)));
    r.v_ = __builtin_shuffle(v_, Places{1, 2, 0, 3});
#endif
    return r;
  }
#else
  double operator[](int i) const { return i < 2 ? low_[i] : high_[i - 2]; }

  Lane& operator+=(Lane b) { return low_ += b.low_, high_ += b.high_, *this; }
  Lane& operator-=(Lane b) { return low_ -= b.low_, high_ -= b.high_, *this; }
  Lane& operator*=(Lane b) { return low_ *= b.low_, high_ *= b.high_, *this; }

  /// (y, z, x).
  Lane Rotated() const { return {low_[1], high_[0], low_[0], 0.0}; }

 private:
  using Two = double __attribute__((vector_size(16)));
  Lane(double x, double y, double z, double w) : low_{x, y}, high_{z, w} {}
  Two low_, high_;
#endif
};

inline Lane operator+(Lane a, Lane b) { return a += b; }
inline Lane operator-(Lane a, Lane b) { return a -= b; }
inline Lane operator*(Lane a, Lane b) { return a *= b; }
inline Lane operator*(double s, Lane a) { return a *= Lane::All(s); }

/// a × b.
inline Lane Cross(Lane a, Lane b) { return (a * b.Rotated() - a.Rotated() * b).Rotated(); }

}  // namespace reckon::estimator
