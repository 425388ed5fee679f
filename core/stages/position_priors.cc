// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/stages/position_priors.h"

#include <algorithm>
#include <limits>

namespace orbweave {
namespace {

constexpr double kUnknownAltitudeSigmaM = 100.0;

/// Standard deviations of an image's position, before what is not known of its altitude.
Eigen::Vector2d SigmaOf(const IngestCandidate& candidate, const IngestOptions& options) {
  const SourceImage& source = *candidate.source;
  double horizontal_m = options.gnss_sigma_m;
  if (candidate.row == nullptr && source.position_sigma_m) return *source.position_sigma_m;
  if (candidate.row == nullptr)
    horizontal_m = source.metadata.position_error_m.value_or(horizontal_m);
  if (candidate.row != nullptr) horizontal_m = candidate.row->accuracy_m.value_or(horizontal_m);
  return {horizontal_m, horizontal_m * options.gnss_vertical_factor};
}

}  // namespace

bool PositionsAreLocal(std::span<const IngestCandidate> candidates, const GnssTable& table) {
  if (!table.rows.empty()) return table.rows.front().position_in_local.has_value();
  return std::none_of(candidates.begin(), candidates.end(), [](const IngestCandidate& candidate) {
    return candidate.source->metadata.position.has_value();
  });
}

PosePrior PriorOf(const IngestCandidate& candidate, bool local, const IngestOptions& options) {
  PosePrior prior;
  const Eigen::Vector2d sigma_m = SigmaOf(candidate, options);
  prior.horizontal_sigma_m = sigma_m.x();
  prior.vertical_sigma_m = sigma_m.y();
  bool altitude_known = candidate.source->metadata.altitude_known;
  if (local) {
    prior.position_in_enu = candidate.row != nullptr ? candidate.row->position_in_local
                                                     : candidate.source->position_in_local;
  } else if (candidate.row != nullptr) {
    prior.geodetic = candidate.row->geodetic;
    altitude_known = candidate.row->altitude_known;
  } else {
    prior.geodetic = candidate.source->metadata.position;
  }
  if (prior.geodetic && !altitude_known) {
    prior.geodetic->altitude_m = std::numeric_limits<double>::quiet_NaN();
    prior.vertical_sigma_m = std::max(prior.vertical_sigma_m, kUnknownAltitudeSigmaM);
  }
  prior.heading_deg = candidate.Either(&GnssRow::heading_deg, &ImageMetadata::heading_deg);
  prior.pitch_deg = candidate.Either(&GnssRow::pitch_deg, &ImageMetadata::pitch_deg);
  prior.roll_deg = candidate.Either(&GnssRow::roll_deg, &ImageMetadata::roll_deg);
  return prior;
}

}  // namespace orbweave
