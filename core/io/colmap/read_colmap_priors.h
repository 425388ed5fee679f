// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/status.h"
#include "core/io/colmap/colmap_database.h"
#include "core/io/sqlite_connection.h"

namespace orbweave {

/// Reads the table pose_priors, if there is one, into the images' priors. Positions that cannot be
/// (latitude and longitude off the Earth or both 0, coordinates beyond 100,000 km, several images
/// at exactly 0/0/0; other than three numbers, or in a coordinate system that is not known),
/// heights and covariances that cannot be are left out, and database.warnings counts and names
/// them.
[[nodiscard]] absl::Status ReadColmapPriors(const SqliteConnection& connection,
                                            ColmapDatabase& database);

}  // namespace orbweave
