// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "absl/status/statusor.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// RFC 7946 FeatureCollection in WGS84: one LineString per drive through its registered images in
/// id order, then one Point per registered image with its name and sigmas. FailedPrecondition: the
/// manifest has no origin.
[[nodiscard]] absl::StatusOr<std::string> TrajectoryGeoJson(
    const std::map<ImageId, RegisteredImage>& images, const ImageManifest& manifest);

}  // namespace orbweave
