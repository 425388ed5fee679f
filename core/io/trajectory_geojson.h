// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "core/io/job_report.h"

namespace orbweave {

/// RFC 7946 FeatureCollection in WGS84 of all models that are georeferenced: one LineString per
/// path (JobReport.paths) with its model and drive, then one Point per placed image with its name,
/// state (registered or loose), model, drive, cluster, observations, mean residual and sigmas.
/// FailedPrecondition: the report has no origin.
[[nodiscard]] absl::StatusOr<std::string> TrajectoryGeoJson(const JobReport& report);

}  // namespace orbweave
