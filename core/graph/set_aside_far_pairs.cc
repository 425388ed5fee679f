// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/set_aside_far_pairs.h"

#include <cstdint>
#include <cstdlib>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/graph/near_by_gnss.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

constexpr size_t kPairsShown = 3;  ///< in the warning

/// Per image its place along the sequence of its drive.
std::vector<int64_t> PlacesInSequence(const ImageManifest& manifest) {
  std::vector<int64_t> places(manifest.images.size(), 0);
  const auto sequences = SequenceOfDrives(manifest);
  for (const auto& [drive, sequence] : sequences) {
    for (size_t i = 0; i < sequence.size(); ++i)
      places[sequence[i].value] = static_cast<int64_t>(i);
  }
  return places;
}

}  // namespace

void SetAsideFarPairs(const PairOptions& options,
                      ImageManifest& manifest,
                      std::vector<TwoViewGeometry>& pairs) {
  const std::vector<int64_t> places = PlacesInSequence(manifest);
  size_t count = 0;
  std::string first;
  std::erase_if(pairs, [&](const TwoViewGeometry& geometry) {
    const ImageRecord& a = manifest.At(geometry.pair.a);
    const ImageRecord& b = manifest.At(geometry.pair.b);
    const bool in_window =
        a.drive == b.drive &&
        std::abs(places[a.id.value] - places[b.id.value]) <= options.sequence_window;
    if (in_window || MayBeNear(a.prior, b.prior, options)) return false;
    if (count++ < kPairsShown)
      absl::StrAppend(&first, count > 1 ? ", " : "", a.name, " and ", b.name);
    return true;
  });
  if (count == 0) return;
  manifest.warnings.push_back(
      absl::StrCat(count,
                   count == 1 ? " pair of images that lies" : " pairs of images that lie",
                   " further apart by GNSS than pairs.similar_gate_m=",
                   options.similar_gate_m,
                   " and pairs.similar_gate_sigmas allow is not used: ",
                   first,
                   count > kPairsShown ? ", ..." : ""));
}

}  // namespace orbweave
