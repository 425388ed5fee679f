// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_vanished_steps.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "core/merging/checks/stops_of_drives.h"

namespace orbweave {
namespace {

/// A step, and how long it is in steps as they are around it.
struct ShortStep {
  ImageId from{};
  ImageId to{};
  double steps = 0.0;
};

std::vector<ShortStep> FindShortSteps(const StopsOfDrive& drive, const ImageManifest& manifest) {
  std::vector<ShortStep> found;
  for (const VanishedStep& vanished : FindVanishedSteps(drive.stops)) {
    std::array<PosePrior, 4> around;
    for (size_t i = 0; i < around.size(); ++i)
      around[i] = manifest.At(drive.images[vanished.stop - 1 + i]).prior;
    if (IsBorneOut(vanished, around)) continue;
    found.push_back({drive.images[vanished.stop], drive.images[vanished.stop + 1], vanished.share});
  }
  return found;
}

}  // namespace

CrossCheck CheckVanishedSteps(const std::map<ImageId, RegisteredImage>& images,
                              const ImageManifest& manifest) {
  CrossCheck check{.name = "vanished_steps", .limit = 1.0 - kMostVanished_steps, .unit = "step"};
  std::vector<ShortStep> found;
  for (const StopsOfDrive& drive : StopsOfDrives(images, manifest))
    std::ranges::copy(FindShortSteps(drive, manifest), std::back_inserter(found));
  if (found.empty()) {
    check.sentence = "no step of an even drive leads hardly anywhere";
    return check;
  }
  const ShortStep& worst = *std::ranges::min_element(found, {}, &ShortStep::steps);
  check.value = 1.0 - worst.steps;
  check.level = CheckLevel::kDoubtful;
  check.sentence = absl::StrFormat(
      "%d steps lead hardly anywhere, first of all the one from %s to %s, %.0f %% of those around, "
      "which are even: where houses are as wide as a step is long the next one is taken for this "
      "one, and all that follows is a step too near, unless the camera stood there; compare the "
      "two "
      "pictures, or give exact GNSS positions",
      found.size(),
      manifest.At(worst.from).name,
      manifest.At(worst.to).name,
      100.0 * worst.steps);
  return check;
}

}  // namespace orbweave
