// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "core/io/colmap/colmap_database.h"
#include "core/io/images/image_sources.h"

namespace orbweave {

/// Reads a database of COLMAP 3.8 to 4.x or SphereSfM: cameras EQUIRECTANGULAR (17: w,h) and SPHERE
/// (11: f,cx,cy), keypoints of 2, 4 or 6 columns, verified matches, else raw ones, pose priors of
/// all layouts. NotFound: no such file. InvalidArgument: not a database, another camera model
/// ("camera 3 is PINHOLE; ..."), an image that is not 2:1, damaged rows, match indices out of
/// range, and what no database should hold (check_colmap_rows.h). Priors that cannot be are left
/// out with a warning. FailedPrecondition: no images, or no matches.
[[nodiscard]] absl::StatusOr<ColmapDatabase> ReadColmapDatabase(const std::string& path);

/// The images of a database as IngestImages takes them; images[i] stays image i (none can be
/// excluded).
[[nodiscard]] ImageSources SourcesFromDatabase(const ColmapDatabase& database);

}  // namespace orbweave
