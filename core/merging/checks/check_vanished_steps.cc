// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_vanished_steps.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/merging/checks/stops_of_drives.h"

namespace orbweave {

std::vector<ShortStep> FindShortSteps(const std::map<ImageId, RegisteredImage>& images,
                                      const ImageManifest& manifest) {
  std::vector<ShortStep> found;
  for (const StopsOfDrive& drive : StopsOfDrives(images, manifest)) {
    const auto prior_of = [&](size_t stop) -> const PosePrior& {
      return manifest.At(drive.images[stop]).prior;
    };
    for (const VanishedStep& vanished : FindVanishedSteps(drive.stops)) {
      if (!IsDoubted(vanished, drive.stops, prior_of)) continue;
      ShortStep& step = found.emplace_back(
          drive.images[vanished.stop], drive.images[vanished.stop + 1], vanished.share);
      if (vanished.end) step.end = drive.images[*vanished.end];
    }
  }
  return found;
}

CrossCheck CheckVanishedSteps(const std::map<ImageId, RegisteredImage>& images,
                              const ImageManifest& manifest) {
  CrossCheck check{.name = "vanished_steps", .limit = 1.0 - kMostVanished_steps, .unit = "step"};
  const std::vector<ShortStep> found = FindShortSteps(images, manifest);
  if (found.empty()) {
    check.sentence = "no step of an even drive leads hardly anywhere, or back";
    return check;
  }
  const ShortStep& worst = *std::ranges::min_element(found, {}, &ShortStep::steps);
  check.value = 1.0 - worst.steps;
  check.level = CheckLevel::kDoubtful;
  check.sentence = absl::StrFormat(
      "%d %s hardly anywhere, or back, first of all the one from %s to %s, %.0f %% %s of those "
      "around, which are even: where houses are as wide as a step is long the next one is taken "
      "for this one, and all that follows is a step or two too near, unless the camera stood "
      "there; compare the two pictures, or give exact GNSS positions",
      found.size(),
      found.size() == 1 ? "step leads" : "steps lead",
      manifest.At(worst.from).name,
      manifest.At(worst.to).name,
      100.0 * std::abs(worst.steps),
      worst.steps < 0.0 ? "back" : "on");
  return check;
}

}  // namespace orbweave
