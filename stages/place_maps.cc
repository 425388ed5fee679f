// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/place_maps.h"

#include "stages/dense_codecs.h"
#include "stages/stage_task.h"

namespace orbweave {

absl::StatusOr<PlacedMaps> PlaceMaps(const DensePlan& plan,
                                     const std::vector<Digest>& maps,
                                     MapUnit unit) {
  if (maps.size() != plan.panoramas.size())
    return absl::InvalidArgumentError("dense: not one depth map for each panorama");
  PlacedMaps placed;
  for (size_t i = 0; i < maps.size(); ++i) {
    const DensePanorama& panorama = plan.panoramas[i];
    placed[panorama.file.image] = {.image = panorama.file.image,
                                   .map = maps[i],
                                   .unit_m = unit == MapUnit::kOwn ? panorama.unit_m : 1.0,
                                   .cam_from_model = panorama.cam_from_model};
  }
  return placed;
}

absl::StatusOr<DepthMap> FetchMap(const PlacedMap& placed, BlobAccess& blobs) {
  ORBWEAVE_ASSIGN_OR_RETURN(DepthMap map, FetchBlob<DepthMap>(placed.map, blobs));
  constexpr float kFarthest_m = 1e9F;
  const auto unit = static_cast<float>(placed.unit_m);
  const auto reach = static_cast<float>(placed.reach_m);
  for (size_t i = 0; i < map.size(); ++i) {
    map.range_m[i] *= unit;
    map.sigma_m[i] *= unit;
    if (!(map.range_m[i] <= kFarthest_m) || !(map.sigma_m[i] <= kFarthest_m))
      return BlameBlob(absl::DataLossError("a depth map sees farther than anything can be"),
                       placed.map);
    if (reach > 0.0F && map.range_m[i] > reach) map.range_m[i] = 0.0F;
  }
  return map;
}

absl::StatusOr<std::vector<DepthMap>> FetchMaps(const std::vector<PlacedMap>& placed,
                                                BlobAccess& blobs,
                                                const StageContext& context) {
  std::vector<DepthMap> maps;
  for (const PlacedMap& map : placed) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    ORBWEAVE_ASSIGN_OR_RETURN(maps.emplace_back(), FetchMap(map, blobs));
  }
  return maps;
}

}  // namespace orbweave
