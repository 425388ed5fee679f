// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/dense/panorama_raster.h"
#include "core/dense/posed_depth_map.h"
#include "core/scene/surface_point.h"

namespace orbweave {

struct FuseOptions {
  double max_reprojection_px = 1.0;
  double yield_px = 0.5;
  double max_depth_sigmas = 3.0;
  double max_normal_angle_deg = 20.0;
  int min_maps = 1;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("max_reprojection_px",
          self.max_reprojection_px,
          "pixels of two depth maps are one place when they see each other so near",
          Range{0.1, 1.0});
    visit("yield_px",
          self.yield_px,
          "the worse of two pixels of one place gives no point when they see each other so near",
          Range{0.1, 1.0});
    visit("max_depth_sigmas",
          self.max_depth_sigmas,
          "and their depths differ by no more than so many sigma",
          Range{0.5, 10});
    visit("max_normal_angle_deg",
          self.max_normal_angle_deg,
          "and their normals by no more than this",
          Range{1, 90});
    visit("min_maps",
          self.min_maps,
          "maps that must agree on a point, its own among them; 2 gives a cleaner cloud with holes",
          Range{1, 8});
  }
};

struct FusedPanorama {
  std::vector<SurfacePoint> points{};  ///< in the order of its pixels; positions quantised
  size_t checked_pixels = 0;
  std::string problem{};  ///< why there are no points, for people; empty when all is well
};

/// What one panorama gives to the cloud so that each piece of surface is given once. A pixel that
/// was checked (kDepthChecked) *agrees* with one of a neighbour's map when, for X and X' their
/// points,
///
///   each is seen less than max_reprojection_px from the other's ray,
///   |n'.(X - X')| is within max_depth_sigmas of its sigma (depths, and normals to 0.05 rad),
///   their normals are within max_normal_angle_deg;
///
/// it *touches* one when both, moved along their rays by a third of a footprint (range x angle of a
/// pixel, the smaller of both), may come within 0.35 footprints. It yields to a pixel that ranks
/// higher when it touches it, or agrees with it and each is seen less than yield_px from the
/// other's ray. Rank: sigma in classes of sqrt 2, then the smaller image, then pixel. Who yields to
/// nobody gives a point on its own ray: the inverse-variance mean of its range and of where its ray
/// meets the planes of those that agree, one of each map, moved by a third of the smallest
/// footprint of all maps there at most; so no two points of different maps come nearer than a third
/// of a footprint. The normal is the weighted mean, the colour that of its own image: it is the
/// best.
///
/// yield_px: at 0.5 the cloud is as dense as the finest map at each place; at 1 it has half as many
/// points where sigmas scatter between classes. min_maps: what merges is right more often than what
/// stays alone, so fewer points leave fewer wrong ones.
///
/// Its sigma is the common one of the maps that agree, less what a mean of maps with common errors
/// gains, and larger where they scatter (RangeMean).
///
/// The rule reads nothing but these maps. Neighbours must be mutual (who is a neighbour has this
/// one as neighbour), else both may give a point; their order does not matter. Neighbours without
/// map or finite pose are left out.
[[nodiscard]] FusedPanorama FusePixels(const PosedDepthMap& own,
                                       const PanoramaRaster& own_image,
                                       std::span<const PosedDepthMap> neighbours,
                                       const FuseOptions& options = {});

}  // namespace orbweave
