// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/dense/tile_grid.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

struct TileReport {
  TileCell cell{};
  std::string file{};
  uint64_t num_points = 0;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
};

/// A dense cloud in numbers.
struct DenseReport {
  static constexpr size_t kSigmaBins = 8;  ///< below 1, 2, 4, ... 64 mm, and above
  static constexpr size_t kViewBins = 9;   ///< borne out by 0 ... 7 panoramas, and by 8 or more

  uint64_t num_points = 0;
  uint32_t panoramas = 0;  ///< that have depth
  double coverage = 0.0;   ///< mean share of the sphere that has a depth that was checked
  std::array<uint64_t, kSigmaBins> by_sigma{};
  std::array<uint64_t, kViewBins> by_views{};
  std::vector<TileReport> tiles{};   ///< ascending by cell
  std::vector<Exclusion> omitted{};  ///< panoramas without depth, by name, and why
  double elapsed_s = 0.0;
  double cpu_s = 0.0;
};

}  // namespace orbweave
