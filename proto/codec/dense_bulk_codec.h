// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/artifacts/dense_records.h"
#include "core/base/status.h"
#include "core/dense/depth_map.h"

/// Depth maps and points. All decoders: DataLoss where bytes are no message, arrays do not
/// match or values are none.

namespace orbweave {

/// Pixels without a range have nothing else: what a map holds there is not kept.
[[nodiscard]] absl::StatusOr<std::string> EncodeDepthMap(const DepthMap& map);
[[nodiscard]] absl::StatusOr<DepthMap> DecodeDepthMap(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeSurfacePoints(const SurfacePoints& points);
[[nodiscard]] absl::StatusOr<SurfacePoints> DecodeSurfacePoints(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeDenseTile(const DenseTile& tile);
[[nodiscard]] absl::StatusOr<DenseTile> DecodeDenseTile(std::string_view bytes);

}  // namespace orbweave
