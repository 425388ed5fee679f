// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/artifacts/dense_records.h"
#include "core/base/stage_context.h"
#include "core/base/status.h"
#include "core/dense/depth_map.h"
#include "core/pipeline/blob_access.h"

namespace orbweave {

using PlacedMaps = std::map<ImageId, PlacedMap>;

/// What the lengths of a depth map count: estimated ones have units of their own, checked ones that
/// of the model.
enum class MapUnit { kOwn, kModel };

/// The depth maps of a plan, `maps[i]` of panorama i, and where they stand. InvalidArgument: not
/// one map for each panorama.
[[nodiscard]] absl::StatusOr<PlacedMaps> PlaceMaps(const DensePlan& plan,
                                                   const std::vector<Digest>& maps,
                                                   MapUnit unit);

/// The map in units of the model, without what lies beyond its reach where it has one. DataLoss: it
/// sees farther than anything can be.
[[nodiscard]] absl::StatusOr<DepthMap> FetchMap(const PlacedMap& placed, BlobAccess& blobs);

/// The same of several, in their order. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<std::vector<DepthMap>> FetchMaps(const std::vector<PlacedMap>& placed,
                                                              BlobAccess& blobs,
                                                              const StageContext& context);

}  // namespace orbweave
