// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/drawing/draw_depth_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/dense/equiangular_raster.h"
#include "core/drawing/canvas.h"
#include "core/drawing/color_scale.h"
#include "core/drawing/lay_panorama.h"

namespace orbweave {
namespace {

constexpr int kWidth_px = kPictureWidth_px / 2;
constexpr int kHeight_px = kWidth_px / 2;
constexpr int kQuality = 85;
constexpr double kLetters_px = 13.0;
constexpr double kShareBeyond = 0.02;  // of the distances, on either side of the scale
constexpr Rgb kUnknown = {22, 24, 28};

/// Colours of distances.
class RangeScale {
 public:
  /// Without any distance the scale is of no use.
  explicit RangeScale(const DepthMap& map) {
    std::vector<float> ranges;
    std::ranges::copy_if(
        map.range_m, std::back_inserter(ranges), [](float range) { return range > 0.0F; });
    if (ranges.empty()) return;
    near_ = At(ranges, kShareBeyond);
    far_ = std::max(At(ranges, 1.0 - kShareBeyond), 1.001 * near_);
  }

  [[nodiscard]] Rgb ColorOf(double range) const {
    return ColorOnScale(std::log(range / near_) / std::log(far_ / near_));
  }

  void Write(const std::string& unit, Canvas& canvas) const {
    int left = 12;
    for (const double range : {near_, std::sqrt(near_ * far_), far_}) {
      const cv::Rect ground = canvas.Label(absl::StrFormat("%.3g %s", range, unit),
                                           {left, 2 * kHeight_px - 40},
                                           kLetters_px,
                                           ColorOf(range));
      left = ground.x + ground.width + 8;
    }
  }

 private:
  static double At(std::vector<float>& ranges, double share) {
    const auto nth =
        ranges.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(ranges.size() - 1));
    std::ranges::nth_element(ranges, nth);
    return *nth;
  }

  double near_ = 1.0;
  double far_ = 2.0;
};

}  // namespace

absl::StatusOr<std::string> DrawDepthMap(const PictureImage& image,
                                         const DepthMap& map,
                                         const std::string& unit) {
  Canvas canvas(kWidth_px, 2 * kHeight_px);
  LayPanorama(image, 0, canvas);
  const EquirectangularCamera camera{kWidth_px, kHeight_px};
  const EquiangularRaster raster{map.face_px};
  const RangeScale scale(map);
  bool is_empty = true;
  for (int row = 0; row < kHeight_px; ++row) {
    for (int column = 0; column < kWidth_px; ++column) {
      const Eigen::Vector3d bearing = camera.BearingFromPixel({column + 0.5, row + 0.5});
      const float range =
          map.face_px == 0 ? 0.0F : map.range_m[raster.Index(raster.PixelFromBearing(bearing))];
      const Rgb color = range > 0.0F ? scale.ColorOf(range) : kUnknown;
      canvas.Pixels().at<cv::Vec3b>(kHeight_px + row, column) = {color.b, color.g, color.r};
      is_empty = is_empty && !(range > 0.0F);
    }
  }
  if (!is_empty) scale.Write(unit, canvas);
  return canvas.Jpeg(kQuality);
}

}  // namespace orbweave
