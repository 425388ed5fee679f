// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/status.h"
#include "core/scene/features.h"

namespace orbweave {

/// Pixels to draw on; positions are in pixels, (0, 0) the corner of the first one. What leaves the
/// canvas is cut off.
class Canvas {
 public:
  Canvas(int width_px, int height_px);

  [[nodiscard]] int Width() const { return pixels_.cols; }
  [[nodiscard]] int Height() const { return pixels_.rows; }
  [[nodiscard]] cv::Mat& Pixels() { return pixels_; }

  void Line(cv::Point2d from, cv::Point2d to, const Rgb& color, int thickness = 1);
  void Curve(const std::vector<cv::Point2d>& points, const Rgb& color, int thickness);
  void Dot(cv::Point2d middle, double radius_px, const Rgb& color);
  void Ring(cv::Point2d middle, double radius_px, const Rgb& color, int thickness);
  /// A square that stands on its corner.
  void Diamond(cv::Point2d middle, double radius_px, const Rgb& color, bool is_filled);
  void Box(const cv::Rect& where, const Rgb& color);
  /// `baseline`: left end of the line that letters stand on.
  void Text(std::string_view text, cv::Point baseline, double height_px, const Rgb& color);
  /// Text on a dark ground; `corner`: its upper left. Returns the ground's extent.
  cv::Rect Label(std::string_view text, cv::Point corner, double height_px, const Rgb& color);

  /// What `draw` draws, `opacity` of it, over what was there.
  void Blend(double opacity, const std::function<void(Canvas&)>& draw);

  /// The bytes of a PNG file, and of a JPEG one.
  [[nodiscard]] absl::StatusOr<std::string> Png() const;
  [[nodiscard]] absl::StatusOr<std::string> Jpeg(int quality) const;

 private:
  explicit Canvas(cv::Mat pixels) : pixels_(std::move(pixels)) {}

  cv::Mat pixels_;
};

/// Extent of `text` when it is drawn with letters of this height.
[[nodiscard]] cv::Size SizeOfText(std::string_view text, double height_px);

}  // namespace orbweave
