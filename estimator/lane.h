#pragma once

// An installed library says which lanes it was built with: its users must have the same.
#if !defined(RECKON_AVX2_LANES)
#if defined(__AVX2__)
#define RECKON_AVX2_LANES 1
#else
#define RECKON_AVX2_LANES 0
#endif
#elif RECKON_AVX2_LANES && !defined(__AVX2__)
#error "reckon was built with AVX2, so this must be too (-mavx2 or -march)"
#endif

#if RECKON_AVX2_LANES
#include <immintrin.h>
#else
#include <cstring>
#endif

namespace reckon::estimator {

/// Four doubles that move together: a 3-vector and a padding number that nobody reads. One AVX2
/// register where the compiler may use those, otherwise two of SSE: a 32-byte vector on plain
/// x86-64 is several times slower than that. The arithmetic is the same either way but for fused
/// multiply-adds.
class Lane {
 public:
  Lane() = default;
  static Lane Zero() { return All(0.0); }

#if RECKON_AVX2_LANES
  Lane(double x, double y, double z) : v_{x, y, z, z} {}
  static Lane All(double s) { return Lane(Four{s, s, s, s}); }
  /// Of three numbers that lie in a row.
  static Lane Load(const double* xyz) {
    return Lane(_mm256_insertf128_pd(_mm256_broadcast_sd(xyz + 2), _mm_loadu_pd(xyz), 0));
  }
  void Store(double* xyz) const {
    _mm_storeu_pd(xyz, _mm256_castpd256_pd128(v_));
    _mm_storel_pd(xyz + 2, _mm256_extractf128_pd(v_, 1));
  }

  /// Into four numbers in a row: beside the three the next one, with anything.
  void StoreFour(double* xyz) const { _mm256_storeu_pd(xyz, v_); }

  double operator[](int i) const { return v_[i]; }

  Lane& operator+=(Lane b) { return v_ += b.v_, *this; }
  Lane& operator-=(Lane b) { return v_ -= b.v_, *this; }
  Lane& operator*=(Lane b) { return v_ *= b.v_, *this; }
  Lane operator-() const { return Lane(-v_); }
#if defined(__FMA__)
  Lane& AddProduct(Lane a, Lane b) { return v_ = _mm256_fmadd_pd(a.v_, b.v_, v_), *this; }
  // Left to choose, compilers take the form that overwrites a factor, and move that out of the way.
  Lane& SubtractProduct(Lane a, Lane b) {
    asm("vfnmadd231pd %1, %2, %0" : "+x"(v_) : "xm"(a.v_), "x"(b.v_));
    return *this;
  }
#else
  Lane& AddProduct(Lane a, Lane b) { return *this += a * b; }
  Lane& SubtractProduct(Lane a, Lane b) { return *this -= a * b; }
#endif

  /// (y, z, x).
  Lane Rotated() const { return Lane(_mm256_permute4x64_pd(v_, 0b11'00'10'01)); }

  /// The columns of d I + [v]×.
  static void DiagonalAndCross(double d, Lane v, Lane& a, Lane& b, Lane& c) {
    const Four D = All(d).v_;
    const Four zy =
        _mm256_xor_pd(_mm256_permute4x64_pd(v.v_, 0b11'01'10'11), Four{0.0, 0.0, -0.0, 0.0});
    const Four zx =
        _mm256_xor_pd(_mm256_permute4x64_pd(v.v_, 0b11'00'11'10), Four{-0.0, 0.0, 0.0, 0.0});
    const Four yx =
        _mm256_xor_pd(_mm256_permute4x64_pd(v.v_, 0b11'11'00'01), Four{0.0, -0.0, 0.0, 0.0});
    a.v_ = _mm256_blend_pd(zy, D, 0b0001);
    b.v_ = _mm256_blend_pd(zx, D, 0b0010);
    c.v_ = _mm256_blend_pd(yx, D, 0b0100);
  }

  /// The columns of a 3×3 matrix become its rows.
  static void Transpose(Lane& a, Lane& b, Lane& c) {
    const Four ab = _mm256_unpacklo_pd(a.v_, b.v_);  // (a₀ b₀ a₂ b₂)
    const Four middle = _mm256_unpackhi_pd(a.v_, b.v_);
    const Four swapped = _mm256_permute_pd(c.v_, 0b0101);
    a.v_ = _mm256_insertf128_pd(ab, _mm256_castpd256_pd128(c.v_), 1);
    b.v_ = _mm256_insertf128_pd(middle, _mm256_castpd256_pd128(swapped), 1);
    c.v_ = _mm256_permute2f128_pd(ab, c.v_, 0x31);
  }

  /// The lower triangle of a 3×3 matrix, by columns, becomes its upper one too.
  static void Mirror(Lane a, Lane& b, Lane& c) {
    c.v_ = _mm256_permute2f128_pd(_mm256_unpacklo_pd(a.v_, b.v_), c.v_, 0x31);
    b.v_ = _mm256_blend_pd(b.v_, _mm256_permute_pd(a.v_, 0b0101), 0b0001);
  }

 private:
  using Four = __m256d;
  explicit Lane(Four v) : v_(v) {}
  Four v_;
#else
  Lane(double x, double y, double z) : low_{x, y}, high_{z, z} {}
  static Lane All(double s) { return Lane(Two{s, s}, Two{s, s}); }
  /// Of three numbers that lie in a row.
  static Lane Load(const double* xyz) {
    Lane v(Two{}, Two{xyz[2], xyz[2]});
    std::memcpy(&v.low_, xyz, sizeof v.low_);
    return v;
  }
  void Store(double* xyz) const {
    std::memcpy(xyz, &low_, sizeof low_);
    xyz[2] = high_[0];
  }

  /// Into four numbers in a row: beside the three the next one, with anything.
  void StoreFour(double* xyz) const {
    std::memcpy(xyz, &low_, sizeof low_);
    std::memcpy(xyz + 2, &high_, sizeof high_);
  }

  double operator[](int i) const { return i < 2 ? low_[i] : high_[i - 2]; }

  Lane& operator+=(Lane b) { return low_ += b.low_, high_ += b.high_, *this; }
  Lane& operator-=(Lane b) { return low_ -= b.low_, high_ -= b.high_, *this; }
  Lane& operator*=(Lane b) { return low_ *= b.low_, high_ *= b.high_, *this; }
  Lane operator-() const { return Lane(-low_, -high_); }
  Lane& AddProduct(Lane a, Lane b) {
    return low_ += a.low_ * b.low_, high_ += a.high_ * b.high_, *this;
  }
  Lane& SubtractProduct(Lane a, Lane b) {
    return low_ -= a.low_ * b.low_, high_ -= a.high_ * b.high_, *this;
  }

  /// (y, z, x).
  Lane Rotated() const { return Lane(Two{low_[1], high_[0]}, Two{low_[0], high_[0]}); }

  /// The columns of d I + [v]×.
  static void DiagonalAndCross(double d, Lane v, Lane& a, Lane& b, Lane& c) {
    a = Lane(d, v[2], -v[1]);
    b = Lane(-v[2], d, v[0]);
    c = Lane(v[1], -v[0], d);
  }

  /// The columns of a 3×3 matrix become its rows.
  static void Transpose(Lane& a, Lane& b, Lane& c) {
    const Two first{a.low_[0], b.low_[0]}, second{a.low_[1], b.low_[1]}, last = c.low_;
    c = Lane(Two{a.high_[0], b.high_[0]}, c.high_);
    b = Lane(second, Two{last[1], last[1]});
    a = Lane(first, last);
  }

  /// The lower triangle of a 3×3 matrix, by columns, becomes its upper one too.
  static void Mirror(Lane a, Lane& b, Lane& c) {
    c.low_ = Two{a.high_[0], b.high_[0]};
    b.low_[0] = a.low_[1];
  }

 private:
  using Two = double __attribute__((vector_size(16)));
  Lane(Two low, Two high) : low_(low), high_(high) {}
  Two low_, high_;
#endif
};

inline Lane operator+(Lane a, Lane b) { return a += b; }
inline Lane operator-(Lane a, Lane b) { return a -= b; }
inline Lane operator*(Lane a, Lane b) { return a *= b; }
inline Lane operator*(double s, Lane a) { return a *= Lane::All(s); }

/// a · b.
inline double Dot(Lane a, Lane b) {
  const Lane product = a * b;
  return product[0] + product[1] + product[2];
}

/// a × b.
inline Lane Cross(Lane a, Lane b) { return (a * b.Rotated() - a.Rotated() * b).Rotated(); }

}  // namespace reckon::estimator
