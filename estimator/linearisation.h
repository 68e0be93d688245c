#pragma once

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <span>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/report.h"

namespace reckon::estimator {

/// One block of a measurement's H: three columns at `slot`.
struct Block {
  ErrorBlock slot;
  Eigen::Matrix3d H;
};

/// A measurement linearised at the state: z = −H ξ + noise in right-invariant error coordinates,
/// with the blocks of H that are not zero and the covariance N of the noise. Which filter uses it
/// does not matter: other error forms convert the blocks.
class Linearisation {
 public:
  Eigen::Vector3d z = Eigen::Vector3d::Zero();
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();

  void Add(ErrorBlock slot, const Eigen::Matrix3d& H) {
    assert(size_ < blocks_.size());
    blocks_[size_++] = {slot, H};
  }

  std::span<const Block> blocks() const { return {blocks_.data(), size_}; }

 private:
  std::array<Block, 5> blocks_;
  std::size_t size_ = 0;
};

}  // namespace reckon::estimator
