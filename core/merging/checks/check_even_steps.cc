// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_even_steps.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/merging/checks/stops_of_drives.h"

namespace orbweave {
namespace {

/// A panorama that stands off its even place.
struct OffPlace {
  ImageId image{};
  double steps = 0.0;
};

std::vector<OffPlace> FindOffPlaces(const StopsOfDrive& drive, const ImageManifest& manifest) {
  std::vector<OffPlace> off;
  for (const UnevenStop& uneven : FindUnevenStops(drive.stops)) {
    const auto prior = [&](size_t stop) -> const PosePrior& {
      return manifest.At(drive.images[stop]).prior;
    };
    if (!IsBorneOut(uneven, prior(uneven.first), prior(uneven.stop), prior(uneven.last)))
      off.push_back({drive.images[uneven.stop], uneven.off_steps});
  }
  return off;
}

}  // namespace

CrossCheck CheckEvenSteps(const std::map<ImageId, RegisteredImage>& images,
                          const ImageManifest& manifest) {
  CrossCheck check{.name = "even_steps", .limit = kLeastUneven_steps, .unit = "step"};
  std::vector<OffPlace> off;
  for (const StopsOfDrive& drive : StopsOfDrives(images, manifest))
    std::ranges::copy(FindOffPlaces(drive, manifest), std::back_inserter(off));
  if (off.empty()) {
    check.sentence = "no panorama stands off the even steps of its drive";
    return check;
  }
  const OffPlace& worst = *std::ranges::max_element(off, {}, &OffPlace::steps);
  check.value = worst.steps;
  check.level = CheckLevel::kDoubtful;
  check.sentence = absl::StrFormat(
      "%d panoramas stand too far along their drive or not far enough, first of all %s by %.1f "
      "steps, while those around are as far apart as ever: where windows or houses repeat it may "
      "stand one off, unless the camera was late there; compare it with its neighbours, or give "
      "exact GNSS positions",
      off.size(),
      manifest.At(worst.image).name,
      worst.steps);
  return check;
}

}  // namespace orbweave
