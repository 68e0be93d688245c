#pragma once

#include <Eigen/Core>
#include <array>

namespace reckon::estimator {

/// What the gyro filter knows of its sources; variances are of one axis.
struct GyroFilterNoise {
  double white = 0.0;       ///< of one sample of α [(rad/s)²]
  double walk = 0.0;        ///< of the difference of the two IMUs' biases, per second [(rad/s)²/s]
  double difference = 0.0;  ///< of that difference at the start [(rad/s)²]
};

/// The angular rate from two sources [Lin et al., DRIFT, section V-F]: α, an IMU, and β, a second
/// IMU or the wheels. DRIFT keeps (ω, b) and moves ω by the differences of α's readings, whose
/// white noise is correlated from one to the next (−½). Here the noise n of the newest reading is
/// the state in place of ω = α − b − n, so that no correlation is left: Q is that n is drawn anew.
/// The bias b is that of the filter behind: one belief of it, not two that disagree. An axis
/// corrects
///     with a second IMU, β = ω + b:   z = β − (α − n̂),      H = −1 on n   (DRIFT's [I I]),
///     with the wheels, β = ω:         z = β − (α − b̂ − n̂),  H = −1 on b and n   ([I 0]).
/// The first halves the noise, and b becomes the mean of both IMUs' biases. How far those lie apart
/// is learned beside it, to tell an outlier from a difference of biases. Does not allocate.
class GyroFilterStage {
 public:
  explicit GyroFilterStage(const GyroFilterNoise& noise);

  void Start();

  /// Takes the next reading of α, `dt_s` after the last.
  void Advance(const Eigen::Vector3d& alpha, double dt_s);

  /// What a second IMU's reading, whose variance is `variance`, is off by on axis i once the
  /// difference of biases is taken out, and the variance of that.
  struct Innovation {
    double z = 0.0, S = 1.0;
  };
  Innovation Expect(int i, double beta, double variance) const;

  /// Corrects axis i with a second IMU.
  void Correct(int i, double beta, double variance);

  /// Corrects the noise of axis i by what a correction of the filter behind knows: z as above and
  /// its variance S, b's included. What b and n then have in common is left out for the one step
  /// that n lives; their correlation is negative.
  void CorrectNoise(int i, double z, double S);

  /// α − n̂: the rate with the bias in it.
  Eigen::Vector3d rate() const;
  /// α's own bias less that of the rate.
  Eigen::Vector3d bias_of_first() const;
  /// Variance of n, the largest of the axes.
  double white_variance() const;
  double white_variance(int i) const { return axes_[static_cast<std::size_t>(i)].P_n; }

 private:
  struct Axis {
    double n = 0.0, P_n = 0.0;  ///< the noise of the newest reading
    double d = 0.0, P_d = 0.0;  ///< β's bias less α's
    double K = 0.0;             ///< share of the second IMU
  };

  GyroFilterNoise noise_;
  Eigen::Vector3d alpha_ = Eigen::Vector3d::Zero();
  std::array<Axis, 3> axes_;
};

}  // namespace reckon::estimator
