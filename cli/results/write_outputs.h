// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/io/page/job_report.h"
#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// Writes everything a finished job leaves in its folder: sparse/N in COLMAP's format, points.ply,
/// cameras.csv, trajectory.geojson, georeference.json, report.json, report.html, trace.json, and
/// carrier_of_IMAGE.png where what goes along with the camera is worth a mask (TellCarriers).
/// Returns the report. Codes of WriteFileAtomically; what was written before stays.
[[nodiscard]] absl::StatusOr<JobReport> WriteOutputs(ClientApi& coordinator,
                                                     const JobStatus& status,
                                                     const std::string& folder);

}  // namespace orbweave
