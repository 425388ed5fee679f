// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/drawing/draw_carrier.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/sphere_cells.h"
#include "core/pictures/encode_picture.h"
#include "core/scene/carrier.h"

namespace orbweave {

absl::StatusOr<std::string> DrawCarrier(std::span<const uint32_t> cells) {
  const EquirectangularCamera camera{1024, 512};
  cv::Mat mask(camera.height_px, camera.width_px, CV_8UC1);
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.cols; ++column) {
      const Eigen::Vector3d bearing = camera.BearingFromPixel({column + 0.5, row + 0.5});
      const bool shows = std::ranges::binary_search(cells, SphereCell(bearing, kCarrierCells));
      mask.at<uint8_t>(row, column) = shows ? 255 : 0;
    }
  }
  return EncodePng(mask);
}

}  // namespace orbweave
