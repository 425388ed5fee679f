// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/dense/equiangular_raster.h"

namespace orbweave {

/// Bearings of the pixels of an equiangular raster by table, and the pixels around a bearing.
class RasterBearings {
 public:
  explicit RasterBearings(EquiangularRaster raster);

  /// Unit bearing, in the camera frame, of the middle of a pixel: raster().BearingFromPixel of it.
  [[nodiscard]] Eigen::Vector3d Of(size_t index) const;
  /// Into `pixels`, each once: those whose middles lie within `limit_px` pixel angles, up to 1,
  /// of a unit vector, on whatever faces they are.
  void Around(const Eigen::Vector3d& bearing, double limit_px, std::vector<size_t>& pixels) const;

  [[nodiscard]] const EquiangularRaster& raster() const { return raster_; }

 private:
  /// The same of the nine pixels about a place. False, and nothing is done, at the edge of a face.
  [[nodiscard]] bool AddBlock(const EquiangularRaster::Place& place,
                              const Eigen::Vector3d& bearing,
                              double limit_chord,
                              std::vector<size_t>& pixels) const;

  EquiangularRaster raster_;
  std::vector<double> tangents_{};
};

}  // namespace orbweave
