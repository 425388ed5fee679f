// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

#include "core/io/job_report.h"

namespace orbweave {

/// The trajectory of model `model` from above as an SVG element: images coloured by cluster,
/// overlap ringed, loose ones hollow, error ellipses (UncertaintyEllipses), seams as diamonds where
/// the two clusters come closest, contradicted GNSS positions as red dashes, a scale bar, and north
/// where the model is georeferenced. Without a georeference the view is along the direction in
/// which the centres spread least. Long trajectories are thinned for drawing. Empty when the model
/// has no image.
[[nodiscard]] std::string TrajectoryMapSvg(const JobReport& report, uint32_t model);

}  // namespace orbweave
