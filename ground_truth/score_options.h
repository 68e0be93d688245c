#pragma once

#include <vector>

namespace reckon::ground_truth {

/// How the estimated trajectory is moved onto the true one before the absolute error is taken.
enum class Alignment {
  kNone,
  kFirstPose,    ///< evo's --align_origin: the first pose of both coincides
  kYawPosition,  ///< least squares over yaw and position: what a filter without a compass can't
                 ///< know
  kSe3,          ///< evo's --align: Umeyama without scale, on positions
  kSim3,         ///< evo's --align --correct_scale
  kFirstYawPosition,  ///< yaw and position of the first pose: an initial tilt error stays an error
};

struct ScoreOptions {
  Alignment align = Alignment::kFirstPose;
  std::vector<double> rpe_m{1.0,
                            10.0};  ///< segment lengths of the relative error, metres of true path
  std::vector<double> rpe_s{10.0};  ///< windows of the relative error, seconds
  double start_s = 0.0;             ///< tracks lose what lies before it, then they are scored
};

}  // namespace reckon::ground_truth
