// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "absl/status/status.h"
#include "core/io/cubes/cube_layout.h"

namespace orbweave {

/// Writes the faces of panoramas as nerfstudio reads them (transforms.json): camera model OPENCV
/// without distortion, `transform_matrix` world_from_camera in the axes of OpenGL (x right, y up, z
/// back), paths relative to the file. Codes of WriteFileAtomically.
[[nodiscard]] absl::Status WriteCubeTransforms(const std::string& path,
                                               const std::map<ImageId, RegisteredImage>& images,
                                               const ImageManifest& manifest,
                                               const CubeLayout& layout);

}  // namespace orbweave
