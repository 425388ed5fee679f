// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/digest.h"
#include "core/dense/select_sources.h"
#include "core/dense/tile_grid.h"
#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/rigid3.h"
#include "core/geometry/sim3.h"
#include "core/scene/ids.h"
#include "core/scene/surface_point.h"

/// What the dense stages hand on. Bulk is named by digest.

namespace orbweave {

/// A subproblem of a finished model, for whose panoramas sources are chosen.
struct ViewRecipe {
  uint32_t world = 0;
  Sim3 model_from_world{};
  Digest subproblem{};
};

/// What the panoramas that a subproblem owns are to be compared with.
struct ChosenSources {
  uint32_t world = 0;
  std::vector<SourceChoice> choices{};  ///< ascending by image
};

/// A panorama as it lies in a file.
struct PanoramaFile {
  ImageId image{};
  EquirectangularCamera camera{};
  Digest content{};
  Digest mask{};  ///< zero: none
};

struct DepthSourceFile {
  PanoramaFile panorama{};
  Rigid3 source_from_reference{};
};

/// All that the depth of one panorama is computed from. Poses are relative, lengths in units of the
/// distance to the first source, and all are rounded far below their noise: a longer street, or
/// another georeference of the same model, leaves them and so the depth map as they are.
struct DepthRecipe {
  PanoramaFile reference{};
  std::vector<DepthSourceFile> sources{};
  std::vector<DepthSeed> seeds{};
  double min_range = 0.0;
  double max_range = 0.0;
  bool mask_ignores_white = true;
  int width_px = 0;  ///< to which all pictures are brought
};

/// A panorama of the dense model.
struct DensePanorama {
  PanoramaFile file{};
  Rigid3 cam_from_model{};
  double unit_m = 1.0;  ///< of its depth map
  std::vector<ImageId> sources{};
};

/// A panorama without depth, and why.
struct DenseOmission {
  ImageId image{};
  std::string reason{};
};

/// What is computed; `panoramas[i]` is part i of the stages that work on panoramas.
struct DensePlan {
  std::vector<DensePanorama> panoramas{};
  std::vector<DenseOmission> omitted{};  ///< ascending by image
  bool mask_ignores_white = true;
};

/// The depth map of a panorama, and where it stands.
struct PlacedMap {
  ImageId image{};
  Digest map{};
  double unit_m = 1.0;
  Rigid3 cam_from_model{};
  /// Where maps are fused: what is farther from the camera is left to others.
  double reach_m = 0.0;
};

/// A map and those of its sources.
struct CheckRecipe {
  PlacedMap own{};
  std::vector<PlacedMap> sources{};
};

/// A checked map and those that may show the same surface.
struct FuseRecipe {
  PlacedMap own{};
  PanoramaFile file{};  ///< for colours
  bool mask_ignores_white = true;
  std::vector<PlacedMap> neighbours{};
};

using SurfacePoints = std::vector<SurfacePoint>;

/// The points of one panorama in one tile.
struct PointsOfCell {
  TileCell cell{};
  uint64_t count = 0;
  Digest points{};  ///< SurfacePoints
};

/// The points of one panorama, ascending by cell.
struct TileRuns {
  std::vector<PointsOfCell> runs{};
};

struct TileRecipe {
  TileCell cell{};
  uint32_t piece = 0;            ///< of the cell, where one alone would hold too many points
  std::vector<Digest> points{};  ///< SurfacePoints, by panorama
};

/// A tile of the dense cloud, its points in the order of GroupByTile.
struct DenseTile {
  TileCell cell{};
  uint32_t piece = 0;
  SurfacePoints points{};
};

}  // namespace orbweave
