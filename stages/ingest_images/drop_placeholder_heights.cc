// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/drop_placeholder_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/quantile.h"

namespace orbweave {
namespace {

// Two may agree by chance, where heights are rounded to metres.
constexpr size_t kFewest = 3;
constexpr double kFarFromNought_m = 10.0;

std::optional<double> StatedHeight(const PosePrior& prior) {
  if (!IsHeightKnown(prior.vertical_sigma_m)) return std::nullopt;
  if (prior.geodetic) return prior.geodetic->altitude_m;
  if (prior.position_in_enu) return prior.position_in_enu->z();
  return std::nullopt;
}

/// The height that stands for none; nullopt where all seem to be measured.
std::optional<double> FindPlaceholder(const ImageManifest& manifest) {
  std::map<double, size_t> times;
  std::vector<double> above_or_below;
  for (const ImageRecord& image : manifest.images) {
    const std::optional<double> height_m = StatedHeight(image.prior);
    if (!height_m) continue;
    ++times[*height_m];
    if (*height_m != 0.0) above_or_below.push_back(std::abs(*height_m));
  }
  if (times.size() == 1 && times.begin()->second >= kFewest) return times.begin()->first;
  const auto nought = times.find(0.0);
  if (nought != times.end() && nought->second >= kFewest &&
      Quantile(std::move(above_or_below), 0.5) >= kFarFromNought_m)
    return 0.0;
  return std::nullopt;
}

/// Of how many positions.
size_t ForgetHeight(double height_m, ImageManifest& manifest) {
  size_t count = 0;
  for (ImageRecord& image : manifest.images) {
    if (StatedHeight(image.prior) != height_m) continue;
    image.prior.vertical_sigma_m = kUnknownHeightSigma_m;
    if (image.prior.geodetic)
      image.prior.geodetic->altitude_m = std::numeric_limits<double>::quiet_NaN();
    ++count;
  }
  return count;
}

}  // namespace

void DropPlaceholderHeights(std::span<const IngestCandidate> candidates, ImageManifest& manifest) {
  const bool is_accuracy_stated = std::ranges::any_of(candidates, [](const IngestCandidate& each) {
    return each.row != nullptr && each.row->vertical_accuracy_m;
  });
  if (is_accuracy_stated) return;
  // Those left may share another.
  while (const std::optional<double> placeholder_m = FindPlaceholder(manifest)) {
    const size_t count = ForgetHeight(*placeholder_m, manifest);
    manifest.warnings.push_back(
        absl::StrCat(count,
                     " positions state a height of exactly ",
                     *placeholder_m,
                     " m, as programs do that know none; it is not used (to use it, state its "
                     "vertical_accuracy in a table)"));
  }
}

}  // namespace orbweave
