// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "absl/status/status.h"
#include "core/base/stage_context.h"
#include "core/synthetic/street_options.h"

namespace orbweave {

/// Renders a street into a folder, the same bytes for any number of threads:
///
///   images/street_0000.jpg, ...   panoramas, JPEG of quality 95 or as asked
///   masks/street_0000.png, ...    white: to be ignored, the carrier's roof or covered nadir and
///                                 moving cars
///   gnss.csv                      name,latitude,longitude,altitude,accuracy,heading; with a gap;
///                                 with a second day also time (seconds since 1970) and drive
///   truth.csv                     name,x,y,z,qw,qx,qy,qz: centre (metres east, north, up) and
///                                 rotation of cam_from_world, of the middle between the lenses
///                                 and the middle of the exposure
///   truth_origin.json             latitude, longitude, altitude of that frame's origin
///   surface.ply                   coloured points of the true surface in the same frame
///
/// InvalidArgument: an option is out of range; Unavailable: a file cannot be written; Cancelled.
[[nodiscard]] absl::Status WriteStreet(const StreetOptions& options,
                                       const std::string& output_dir,
                                       const StageContext& context);

}  // namespace orbweave
