// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/io/page/job_report.h"

namespace orbweave {

/// Models that share a frame, and hence a map.
struct MapFrame {
  bool georeferenced = false;
  std::vector<uint32_t> models{};  ///< ascending
};

/// All georeferenced models together, every other one alone; most images first.
[[nodiscard]] std::vector<MapFrame> MapFrames(const JobReport& report);

/// The trajectory from above as an SVG element: registered images as dots, coloured by cluster or,
/// where the frame has several models, by model; overlap ringed, lines along JobReport.paths, error
/// ellipses (UncertaintyEllipses), seams where the two clusters come closest, a scale bar. Loose
/// images, images without a pose at their GNSS positions, and contradicted GNSS positions have
/// shapes of their own (MapSymbol); what lies far outside is drawn at the map's edge. North is up
/// where the frame is georeferenced; otherwise the view is along the direction in which the centres
/// spread least. Long trajectories are thinned for drawing. Empty when the frame has no image.
[[nodiscard]] std::string TrajectoryMapSvg(const JobReport& report, const MapFrame& frame);

/// What is seen on `map`, the drawing of that frame, and no more; and how much was left off it.
[[nodiscard]] std::string MapKeyHtml(const JobReport& report,
                                     const MapFrame& frame,
                                     const std::string& map);

}  // namespace orbweave
