#include "reckon/harness/recorded_tracks.h"

#include "reckon/ground_truth/recording_reader.h"
#include "reckon/harness/truth_history.h"

namespace reckon::harness {
namespace {

using ground_truth::Track;
using ground_truth::Truth;

/// Rows of truth kept while they are paired: estimates lag by less.
constexpr std::size_t kPairingRows = 4096;

/// Pairs each estimate with truth at its stamp, one pass over both.
void PairSamples(const ground_truth::RecordingReader& reader, std::size_t estimator,
                 bool with_holes, Track& track) {
  TruthHistory history(kPairingRows);
  if (with_holes) history.AllowHoles();
  auto truths = reader.ReadTruth();
  auto estimates = reader.ReadEstimates(estimator);
  std::optional<Truth> newest = truths.Next();
  if (newest) history.Add(*newest);
  while (const auto estimate = estimates.Next()) {
    while (newest && newest->t_ns < estimate->t_ns) {
      newest = truths.Next();
      if (newest) history.Add(*newest);
    }
    history.Pair(*estimate, track);
  }
}

}  // namespace

std::map<std::string, Track> ReadTracks(const std::filesystem::path& recording, bool with_holes) {
  const ground_truth::RecordingReader reader(recording);
  std::map<std::string, Track> tracks;
  for (std::size_t i = 0; i < reader.estimators().size(); ++i) {
    Track& track = tracks[reader.estimators()[i]];
    PairSamples(reader, i, with_holes, track);
    auto corrections = reader.ReadCorrections(i);
    while (const auto correction = corrections.Next()) track.Add(*correction);
    auto refusals = reader.ReadRefusals(i);
    while (const auto refused = refusals.Next()) {
      track.AddRefusal(refused->sensor, refused->valid_ns, refused->reason);
    }
  }
  return tracks;
}

}  // namespace reckon::harness
