// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/drop_shared_angles.h"

#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace orbweave {
namespace {

// Two may agree by chance, at a resolution of a degree even on a straight street.
constexpr size_t kFewestImages = 3;

struct Angle {
  const char* name = "";
  std::optional<double> PosePrior::*value{};
  std::optional<double> GnssRow::*sigma{};
};

/// The value that all images share which have one; nullopt where they differ or are too few.
std::optional<double> SharedValue(const ImageManifest& manifest, const Angle& angle) {
  std::optional<double> shared;
  size_t count = 0;
  for (const ImageRecord& image : manifest.images) {
    const std::optional<double>& value = image.prior.*angle.value;
    if (!value) continue;
    if (shared && *shared != *value) return std::nullopt;
    shared = value;
    ++count;
  }
  return count < kFewestImages ? std::nullopt : shared;
}

/// The value that was taken away; nullopt: none was.
std::optional<double> DropIfShared(std::span<const IngestCandidate> candidates,
                                   const Angle& angle,
                                   ImageManifest& manifest) {
  const std::optional<double> shared = SharedValue(manifest, angle);
  if (!shared || std::fmod(*shared, 90.0) != 0.0) return std::nullopt;
  for (const IngestCandidate& candidate : candidates) {
    if (candidate.row != nullptr && candidate.row->*angle.sigma) return std::nullopt;
  }
  for (ImageRecord& image : manifest.images) (image.prior.*angle.value).reset();
  return shared;
}

}  // namespace

void DropSharedAngles(std::span<const IngestCandidate> candidates, ImageManifest& manifest) {
  std::map<double, std::vector<const char*>> angles_by_value;
  for (const Angle& angle : {Angle{"heading", &PosePrior::heading_deg, &GnssRow::heading_sigma_deg},
                             Angle{"pitch", &PosePrior::pitch_deg, &GnssRow::tilt_sigma_deg},
                             Angle{"roll", &PosePrior::roll_deg, &GnssRow::tilt_sigma_deg}}) {
    const std::optional<double> dropped = DropIfShared(candidates, angle, manifest);
    if (dropped) angles_by_value[*dropped].push_back(angle.name);
  }
  for (const auto& [value_deg, names] : angles_by_value) {
    manifest.warnings.push_back(absl::StrCat("all images that state a ",
                                             absl::StrJoin(names, " or a "),
                                             " state exactly ",
                                             value_deg,
                                             " degrees, as programs do that know none; it is not "
                                             "used (to use it, state its accuracy in a table)"));
  }
}

}  // namespace orbweave
