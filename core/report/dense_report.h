// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/dense/tile_grid.h"
#include "core/io/page/job_report.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

struct TileReport {
  TileCell cell{};
  std::string file{};
  uint64_t num_points = 0;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
};

/// The checked depth map of a panorama.
struct DepthMapReport {
  std::string image{};
  double coverage = 0.0;  ///< share of the sphere that has a depth
};

/// A dense cloud in numbers.
struct DenseReport {
  /// Upper ends of all bins but the last, in thousandths of `sigma_unit`.
  static constexpr std::array<int, 7> kSigmaBounds = {1, 2, 4, 8, 16, 32, 64};
  static constexpr size_t kSigmaBins = kSigmaBounds.size() + 1;
  static constexpr size_t kViewBins = 9;  ///< borne out by 0 ... 7 panoramas, and by 8 or more

  std::string title{};
  std::string version{};
  bool is_metric = true;  ///< lengths are metres, not units of a free frame
  uint64_t num_points = 0;
  std::vector<DepthMapReport> maps{};  ///< of all panoramas that took part, in the job's order
  double sigma_unit = 1.0;  ///< a metre; in a free frame the median distance of neighbours
  std::array<uint64_t, kSigmaBins> by_sigma{};
  std::array<uint64_t, kViewBins> by_views{};
  std::vector<TileReport>
      tiles{};  ///< ascending by cell; more than one of a cell with very many points
  std::vector<Exclusion> omitted{};  ///< panoramas without depth, by name, and why
  double elapsed_s = 0.0;
  std::vector<ReportStage> stages{};

  /// Mean over all maps; 0 without any.
  [[nodiscard]] double Coverage() const;
  [[nodiscard]] double Cpu_s() const;
};

/// What is shown beside the numbers.
struct DensePictures {
  std::string from_above_png{};  ///< empty: there is no point
  double pixel = 0.0;            ///< its pixel's edge
  struct Depth {
    std::string image{};
    std::string jpeg{};
  };
  std::vector<Depth> depths{};
};

}  // namespace orbweave
