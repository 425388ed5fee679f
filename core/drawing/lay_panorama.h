// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/drawing/canvas.h"
#include "core/drawing/picture_image.h"
#include "core/drawing/sphere_curve.h"

namespace orbweave {

/// Where a panorama lies on a canvas: over its whole width, from row `top_px` on.
struct LaidPanorama {
  EquirectangularCamera camera{};
  int width_px = 0;
  int top_px = 0;

  [[nodiscard]] int Height() const { return width_px / 2; }
  [[nodiscard]] cv::Point2d At(const Eigen::Vector2d& pixel) const {
    return {pixel.x() * width_px / camera.width_px,
            top_px + pixel.y() * Height() / camera.height_px};
  }
  [[nodiscard]] cv::Point2d AtBearing(const Eigen::Vector3d& bearing) const {
    return At(camera.PixelFromBearing(bearing));
  }
};

/// Of every picture: what its lines of text need, and not more pixels than a panorama has to show.
inline constexpr int kPictureWidth_px = 2048;

/// Paints the panorama onto the canvas from row `top_px` on, somewhat darkened, with marks each 90
/// degrees of azimuth. Without pixels, or where they cannot be decoded, dark with a grid of 30
/// degrees.
LaidPanorama LayPanorama(const PictureImage& image, int top_px, Canvas& canvas);

/// A curve of SphereCurve.
void DrawCurves(const std::vector<PixelCurve>& curves,
                const LaidPanorama& panorama,
                const Rgb& color,
                int thickness,
                Canvas& canvas);

/// Texts from row `top_px` on, the first one as a title, each broken into lines between words.
void WriteHeadlines(std::span<const std::string> texts, int top_px, Canvas& canvas);
[[nodiscard]] int HeightOfHeadlines(std::span<const std::string> texts);

}  // namespace orbweave
