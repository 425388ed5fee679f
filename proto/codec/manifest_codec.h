// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"
#include "core/io/images/cluster_table.h"
#include "core/io/images/image_sources.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Paths are not written: a decoded source knows its mask by file name alone.
[[nodiscard]] absl::StatusOr<std::string> EncodeImageSources(const ImageSources& sources);
[[nodiscard]] absl::StatusOr<ImageSources> DecodeImageSources(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeClusterNames(const ClusterNames& clusters);
/// DataLoss unless there is one cluster per image.
[[nodiscard]] absl::StatusOr<ClusterNames> DecodeClusterNames(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeImageManifest(const ImageManifest& manifest);
/// DataLoss: a camera without a size, priors that are no numbers.
[[nodiscard]] absl::StatusOr<ImageManifest> DecodeImageManifest(std::string_view bytes);

}  // namespace orbweave
