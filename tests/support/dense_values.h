// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "core/dense/depth_map.h"

/// One of each that the dense stages hand on, with nothing left at its default.

namespace orbweave::testing {

inline PanoramaFile SomeFile(uint32_t image) {
  return {.image = ImageId(image),
          .camera = {2048, 1024},
          .content = DigestOf("image"),
          .mask = DigestOf("mask")};
}

inline Rigid3 SomePose() {
  return {Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), Eigen::Vector3d(1.0, -2.0, 3.0)};
}

inline std::vector<DepthSeed> SomeSeeds() {
  return {{.bearing = {0.0, 0.6, 0.8}, .range_m = 7.5, .sigma_m = 0.25}};
}

inline ViewRecipe SomeViewRecipe() {
  return {.world = 2,
          .model_from_world = {2.0, SomePose().rotation, {4.0, 5.0, 6.0}},
          .subproblem = DigestOf("subproblem")};
}

inline ChosenSources SomeChosenSources() {
  return {.world = 1,
          .choices = {{.image = ImageId(3),
                       .sources = {ImageId(4), ImageId(2)},
                       .seeds = SomeSeeds(),
                       .min_range_m = 1.0,
                       .max_range_m = 40.0},
                      {.image = ImageId(9), .problem = "it stands alone"}}};
}

inline DepthRecipe SomeDepthRecipe() {
  return {.reference = SomeFile(3),
          .sources = {{SomeFile(4), SomePose()}},
          .seeds = SomeSeeds(),
          .min_range = 0.5,
          .max_range = 16.0,
          .mask_ignores_white = true,
          .width_px = 1024};
}

inline DensePlan SomeDensePlan() {
  return {.panoramas = {{.file = SomeFile(3),
                         .cam_from_model = SomePose(),
                         .unit_m = 2.5,
                         .sources = {ImageId(4)}}},
          .omitted = {{ImageId(5), "it is in no model"}},
          .mask_ignores_white = true};
}

inline PlacedMap SomePlacedMap(uint32_t image) {
  return {.image = ImageId(image),
          .map = DigestOf("map"),
          .unit_m = 2.5,
          .cam_from_model = SomePose(),
          .reach_m = 12.0};
}

inline CheckRecipe SomeCheckRecipe() {
  return {.own = SomePlacedMap(3), .sources = {SomePlacedMap(4), SomePlacedMap(5)}};
}

inline FuseRecipe SomeFuseRecipe() {
  return {.own = SomePlacedMap(3),
          .file = SomeFile(3),
          .mask_ignores_white = true,
          .neighbours = {SomePlacedMap(4)}};
}

/// With a range at every third pixel.
inline DepthMap SomeDepthMap() {
  DepthMap map{.face_px = 2, .problem = "no problem"};
  for (int i = 0; i < 24; ++i) {
    const bool is_known = i % 3 == 1;
    map.range_m.push_back(is_known ? 2.0F + static_cast<float>(i) : 0.0F);
    map.normals.push_back(is_known ? OctahedralNormal{static_cast<int16_t>(i), -7}
                                   : OctahedralNormal{});
    map.sigma_m.push_back(is_known ? 0.01F : 0.0F);
    map.views.push_back(is_known ? 3 : 0);
    map.flags.push_back(is_known ? kDepthChecked : 0);
  }
  return map;
}

inline SurfacePoints SomeSurfacePoints() {
  return {{.position_in_world = {1.5, -2.0005, 300.0},
           .normal_in_world = {0.0F, 0.6F, -0.8F},
           .color = {10, 20, 30},
           .sigma_m = 0.02F,
           .views = 4},
          {.position_in_world = {1.6, -2.0, 300.0}}};
}

inline TileRuns SomeTileRuns() {
  return {{{.cell = {-3, 4}, .count = 2, .points = DigestOf("points")}}};
}

inline TileRecipe SomeTileRecipe() {
  return {.cell = {-3, 4}, .piece = 2, .points = {DigestOf("points"), DigestOf("more")}};
}

inline DenseTile SomeDenseTile() {
  return {.cell = {-3, 4}, .piece = 1, .points = SomeSurfacePoints()};
}

}  // namespace orbweave::testing
