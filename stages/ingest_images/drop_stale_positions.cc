// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/drop_stale_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/sequence_of_drive.h"
#include "stages/ingest_images/join_gnss_rows.h"

namespace orbweave {
namespace {

constexpr double kMetresPerDegree = 111320.0;  // of latitude
// Fewer may be round by chance.
constexpr size_t kFewest = 4;

/// To what positions are rounded, coarsest first: powers of ten of a degree, minutes and seconds.
constexpr std::array<double, 8> kSteps_deg = {
    1e-2, 1e-3, 1.0 / 3600.0, 1.0 / 6000.0, 1e-4, 1.0 / 36000.0, 1.0 / 60000.0, 1e-5};
constexpr std::array<double, 3> kSteps_m = {100.0, 10.0, 1.0};

bool IsMultiple(double value, double step) {
  constexpr double kTolerance = 1e-6;
  const double steps = value / step;
  return std::abs(steps - std::round(steps)) < kTolerance;
}

using Places = std::set<std::pair<double, double>>;

/// Latitudes and longitudes, or local coordinates of images that have none.
Places PlacesOf(const ImageManifest& manifest, bool geodetic) {
  Places places;
  for (const ImageRecord& image : manifest.images) {
    const PosePrior& prior = image.prior;
    if (geodetic && prior.geodetic) {
      places.emplace(prior.geodetic->latitude_deg, prior.geodetic->longitude_deg);
    } else if (!geodetic && !prior.geodetic && prior.position_in_enu) {
      places.emplace(prior.position_in_enu->x(), prior.position_in_enu->y());
    }
  }
  return places;
}

/// The coarsest of `steps` that all coordinates are multiples of; 0: none, or too few places.
double StepOf(const Places& places, std::span<const double> steps) {
  if (places.size() < kFewest) return 0.0;
  for (const double step : steps) {
    const bool are_multiples = std::ranges::all_of(places, [step](const auto& place) {
      return IsMultiple(place.first, step) && IsMultiple(place.second, step);
    });
    if (are_multiples) return step;
  }
  return 0.0;
}

/// To what length positions are rounded, metres; 0 where to less than one.
double RoundedTo_m(const ImageManifest& manifest) {
  return std::max(kMetresPerDegree * StepOf(PlacesOf(manifest, true), kSteps_deg),
                  StepOf(PlacesOf(manifest, false), kSteps_m));
}

bool IsRepeated(const ImageRecord& before, const ImageRecord& image) {
  if (!before.prior.position_in_enu || !image.prior.position_in_enu) return false;
  const bool is_same_time = before.capture_time_s && image.capture_time_s &&
                            *before.capture_time_s == *image.capture_time_s;
  return !is_same_time && *before.prior.position_in_enu == *image.prior.position_in_enu;
}

void AllowForRounding(double rounded_to_m, ImageManifest& manifest) {
  for (ImageRecord& image : manifest.images) {
    double& sigma_m = image.prior.horizontal_sigma_m;
    sigma_m = std::hypot(sigma_m, rounded_to_m / std::sqrt(12.0));
  }
}

}  // namespace

void DropStalePositions(ImageManifest& manifest) {
  if (const double rounded_to_m = RoundedTo_m(manifest); rounded_to_m > 0.0) {
    AllowForRounding(rounded_to_m, manifest);
    return;
  }
  std::vector<ImageId> stale;
  for (const auto& [drive, sequence] : SequenceOfDrives(manifest)) {
    for (size_t i = 1; i < sequence.size(); ++i) {
      if (IsRepeated(manifest.At(sequence[i - 1]), manifest.At(sequence[i])))
        stale.push_back(sequence[i]);
    }
  }
  std::vector<std::string> names;
  for (const ImageId id : stale) {
    ImageRecord& image = manifest.images[id.value];
    image.prior.position_in_enu.reset();
    image.prior.geodetic.reset();
    names.push_back(image.name);
  }
  const std::string why =
      " that of the image before to the last digit, as from a receiver that reports less often "
      "than pictures are taken; not used";
  WarnOfNames(
      names, ("position repeats" + why).c_str(), ("positions repeat" + why).c_str(), manifest);
}

}  // namespace orbweave
