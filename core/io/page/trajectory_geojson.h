// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "core/io/page/job_report.h"

namespace orbweave {

/// RFC 7946 FeatureCollection in WGS84 of a job with a model that is georeferenced: one LineString
/// per path of such models (JobReport.paths) with its model and drive, then one feature per
/// panorama with its name, state (registered, loose or not_registered), drive and cluster, and
/// where it has a pose model, observations, mean residual and sigmas. It is a Point; of what has no
/// place on earth the geometry is null. Why that is so, or why it is loose, is its `reason`.
/// FailedPrecondition: the report has no origin.
[[nodiscard]] absl::StatusOr<std::string> TrajectoryGeoJson(const JobReport& report);

}  // namespace orbweave
