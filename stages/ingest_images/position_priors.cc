// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/position_priors.h"

#include <algorithm>
#include <limits>

namespace orbweave {
namespace {

/// Standard deviations of an image's position (horizontal, vertical), before what is not known of
/// its altitude: as stated, else by the fix type, else the job's default.
Eigen::Vector2d SigmaOf(const IngestCandidate& candidate, const IngestOptions& options) {
  const SourceImage& source = *candidate.source;
  const GnssRow* row = candidate.row;
  if (row == nullptr && source.position_sigma_m) return *source.position_sigma_m;
  double horizontal_m = options.gnss_sigma_m;
  if (row == nullptr) {
    horizontal_m = source.metadata.position_error_m.value_or(horizontal_m);
  } else {
    if (row->fix) horizontal_m = SigmaOfFix(*row->fix).value_or(horizontal_m);
    horizontal_m = row->accuracy_m.value_or(horizontal_m);
  }
  const double vertical_m = horizontal_m * options.gnss_vertical_factor;
  return {horizontal_m,
          row == nullptr ? vertical_m : row->vertical_accuracy_m.value_or(vertical_m)};
}

/// Heading, pitch and roll with their standard deviations: those that the table states belong to
/// the table's angles alone.
void SetDirection(const IngestCandidate& candidate,
                  const IngestOptions& options,
                  PosePrior& prior) {
  const GnssRow* row = candidate.row;
  prior.heading_deg = candidate.Either(&GnssRow::heading_deg, &ImageMetadata::heading_deg);
  prior.pitch_deg = candidate.Either(&GnssRow::pitch_deg, &ImageMetadata::pitch_deg);
  prior.roll_deg = candidate.Either(&GnssRow::roll_deg, &ImageMetadata::roll_deg);
  prior.heading_sigma_deg = options.heading_sigma_deg;
  prior.tilt_sigma_deg = options.tilt_sigma_deg;
  if (row == nullptr) return;
  if (row->heading_deg && row->heading_sigma_deg) prior.heading_sigma_deg = *row->heading_sigma_deg;
  if ((row->pitch_deg || row->roll_deg) && row->tilt_sigma_deg)
    prior.tilt_sigma_deg = *row->tilt_sigma_deg;
}

}  // namespace

bool PositionsAreLocal(std::span<const IngestCandidate> candidates, const GnssTable& table) {
  if (!table.rows.empty()) {
    return std::ranges::any_of(
        table.rows, [](const GnssRow& row) { return row.position_in_local.has_value(); });
  }
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
    prior.vertical_sigma_m = kUnknownHeightSigma_m;
  }
  SetDirection(candidate, options, prior);
  return prior;
}

}  // namespace orbweave
