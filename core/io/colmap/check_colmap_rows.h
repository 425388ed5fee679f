// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "absl/status/status.h"
#include "core/io/colmap/colmap_database.h"

namespace orbweave {

/// Questions that SQLite's own constraints answer only in databases that kept them. All errors are
/// InvalidArgument and name `path` and the row.

/// Each image has a name of at most 4096 bytes of its own, and an image_id of its
/// own that COLMAP's pair ids can hold.
[[nodiscard]] absl::Status CheckColmapImages(const ColmapDatabase& database,
                                             const std::string& path);

/// The keypoints of an image lie within it (to a pixel), and eight and more not all at one place.
[[nodiscard]] absl::Status CheckColmapKeypoints(const DatabaseImage& image,
                                                const std::string& path);

/// Pairs sorted by their ids: none is there twice.
[[nodiscard]] absl::Status CheckColmapPairs(const ColmapDatabase& database,
                                            const std::string& where);

}  // namespace orbweave
