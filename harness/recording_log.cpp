#include "reckon/harness/recording_log.h"

#include <stdexcept>

namespace reckon::harness {

RecordingLog::RecordingLog(const std::filesystem::path& path)
    : reader_(path), measurements_(reader_.ReadMeasurements()), truth_(reader_.ReadTruth()) {
  const auto prior = reader_.estimators().empty() ? std::nullopt : reader_.ReadPrior(0);
  if (!prior) throw std::invalid_argument(path.string() + " holds no prior to start from");
  prior_ = *prior;
}

estimator::Prior RecordingLog::Start(const InitialConfig& /*initial*/, std::uint64_t /*seed*/) {
  return prior_;
}

}  // namespace reckon::harness
