// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/scene/features.h"
#include "core/scene/image_manifest.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

enum class DatabaseCameraModel {
  kEquirectangular,  ///< id 17, COLMAP 4.1 and later
  kSphere,           ///< id 11, SphereSfM
};

/// Writes the tables of COLMAP 4.x (a superset of those of 3.8: each image also is its own frame of
/// a one-camera rig), replacing `path`. image_id = ImageId + 1. `features` by ImageId; descriptors
/// are written where present. Codes of WriteFileAtomically.
[[nodiscard]] absl::Status WriteColmapDatabase(
    const std::string& path,
    const ImageManifest& manifest,
    const std::vector<Features>& features,
    const std::vector<TwoViewGeometry>& pairs,
    DatabaseCameraModel model = DatabaseCameraModel::kEquirectangular);

}  // namespace orbweave
