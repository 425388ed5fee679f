// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/dense/dense_options.h"
#include "core/dense/match_kernel.h"
#include "core/dense/reference_raster.h"
#include "core/dense/source_faces.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// Everything that patches are matched with at one scale. Not copied: it holds places of its own
/// vectors.
struct MatchScale {
  MatchScale(const GreyPanorama& reference,
             std::span<const GreyPanorama> sources,
             std::span<const Rigid3> sources_from_reference,
             int times_halved);
  MatchScale(const MatchScale&) = delete;
  MatchScale& operator=(const MatchScale&) = delete;

  int times_halved;
  ReferenceRaster raster;
  std::vector<SourceFaces> sources{};
  std::vector<std::array<MatchView, kCubeFaces>> views{};  ///< of each source, by reference face
  /// Centres of the sources in the frame of each face of the reference.
  std::vector<std::array<Eigen::Vector3f, kCubeFaces>> centres{};
};

/// kMatchLanes pixels of a colour in a row of the reference raster, from a column on; rows and
/// columns count from the apron's corner.
struct MatchPlace {
  int face = 0;
  int row = 0;
  int column = 0;
};

/// Weights, moments and rays of the pixels at a place.
void PreparePatches(const MatchScale& scale, const MatchPlace& place, ReferencePatches& patches);

}  // namespace orbweave
