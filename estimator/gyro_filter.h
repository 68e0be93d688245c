#pragma once

#include <Eigen/Core>
#include <array>

namespace reckon::estimator {

/// What the gyro filter knows of its sources; variances are of one axis.
struct GyroFilterNoise {
  double white = 0.0;             ///< of one sample of α [(rad/s)²]
  double walk = 0.0;              ///< of α's bias, and of β's, per second [(rad/s)²/s]
  double second_imu_bias = 1e-2;  ///< of β's turn-on bias [(rad/s)²]
};

/// The angular rate from two sources [Lin et al., DRIFT, section V-F]: α, an IMU, and β, a second
/// IMU or the wheels. DRIFT keeps (ω, b) and moves ω by the differences of α's readings, whose
/// white noise is correlated from one to the next (−½). Here the noise n of the newest reading is a
/// state, so that no correlation is left; ω = α − b − n then follows from the others, and so does
/// Q: the biases walk and n is drawn anew. With c the second IMU's own bias, an axis corrects with
///     z = β − (ω̂ + ĉ),   H = (−1, −1, 1) on (b, n, c) for a second IMU,
///     z = β − ω̂,         H = (−1, −1, 0) for a kinematic model,
/// which are DRIFT's [I I] (c = b there) and [I 0]. Only the latter observes b. Does not allocate.
class GyroFilterStage {
 public:
  /// What a correction was: innovation and its variance.
  struct Innovation {
    double z = 0.0, S = 1.0;
    double nis() const { return z * z / S; }
  };

  explicit GyroFilterStage(const GyroFilterNoise& noise);

  /// Starts from α's bias and the variance of one axis of it.
  void Start(const Eigen::Vector3d& bias, double variance);

  /// Takes the next reading of α, `dt_s` after the last.
  void Advance(const Eigen::Vector3d& alpha, double dt_s);

  /// What axis i of β would correct with; `variance` is β's. `from_imu`: β has a bias.
  Innovation Expect(int i, double beta, double variance, bool from_imu) const;
  void Correct(int i, const Innovation& innovation, bool from_imu);

  Eigen::Vector3d rate() const;
  Eigen::Vector3d bias() const;
  Eigen::Vector3d bias_variance() const;
  /// Variance of what is white in the rate, an axis each.
  Eigen::Vector3d white_variance() const;

 private:
  struct Axis {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();  ///< b, n, c
    Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  };

  static Eigen::Vector3d Row(bool from_imu) { return {-1.0, -1.0, from_imu ? 1.0 : 0.0}; }

  GyroFilterNoise noise_;
  Eigen::Vector3d alpha_ = Eigen::Vector3d::Zero();
  std::array<Axis, 3> axes_;
};

}  // namespace reckon::estimator
