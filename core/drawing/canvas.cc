// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/pictures/encode_picture.h"

namespace orbweave {
namespace {

constexpr int kShift = 4;  // positions are given in sixteenths of a pixel
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kLetter_px = 22.0;  // height of the font's capitals at scale 1
constexpr double kFarOff_px = 1e6;   // beyond what fixed point numbers hold

cv::Scalar ToScalar(const Rgb& color) { return cv::Scalar(color.b, color.g, color.r); }

cv::Point Fixed(cv::Point2d point) {
  const auto fixed = [](double value) {
    // The middle of the first pixel is (0, 0) to OpenCV.
    return static_cast<int>(
        std::lround((std::clamp(value, -kFarOff_px, kFarOff_px) - 0.5) * (1 << kShift)));
  };
  return {fixed(point.x), fixed(point.y)};
}

int FixedLength(double length_px) {
  return std::max(1, static_cast<int>(std::lround(length_px * (1 << kShift))));
}

/// The font has ASCII alone: one question mark for each other letter.
std::string AsciiText(std::string_view text) {
  std::string ascii;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xc0) continue;  // the rest of a letter of several bytes
    ascii += byte < 0x20 || byte >= 0x7f ? '?' : c;
  }
  return ascii;
}

int Stroke(double height_px) { return height_px >= 15.0 ? 2 : 1; }

}  // namespace

cv::Size SizeOfText(std::string_view text, double height_px) {
  int below = 0;
  return cv::getTextSize(AsciiText(text), kFont, height_px / kLetter_px, Stroke(height_px), &below);
}

Canvas::Canvas(int width_px, int height_px)
    : pixels_(height_px, width_px, CV_8UC3, cv::Scalar::all(0)) {}

void Canvas::Line(cv::Point2d from, cv::Point2d to, const Rgb& color, int thickness) {
  cv::line(pixels_, Fixed(from), Fixed(to), ToScalar(color), thickness, cv::LINE_AA, kShift);
}

void Canvas::Curve(const std::vector<cv::Point2d>& points, const Rgb& color, int thickness) {
  std::vector<cv::Point> fixed;
  for (const cv::Point2d& point : points) fixed.push_back(Fixed(point));
  cv::polylines(pixels_, fixed, false, ToScalar(color), thickness, cv::LINE_AA, kShift);
}

void Canvas::Dot(cv::Point2d middle, double radius_px, const Rgb& color) {
  cv::circle(pixels_,
             Fixed(middle),
             FixedLength(radius_px),
             ToScalar(color),
             cv::FILLED,
             cv::LINE_AA,
             kShift);
}

void Canvas::Ring(cv::Point2d middle, double radius_px, const Rgb& color, int thickness) {
  cv::circle(pixels_,
             Fixed(middle),
             FixedLength(radius_px),
             ToScalar(color),
             thickness,
             cv::LINE_AA,
             kShift);
}

void Canvas::Diamond(cv::Point2d middle, double radius_px, const Rgb& color, bool is_filled) {
  const std::vector<cv::Point> corners = {Fixed(middle + cv::Point2d(0.0, -radius_px)),
                                          Fixed(middle + cv::Point2d(radius_px, 0.0)),
                                          Fixed(middle + cv::Point2d(0.0, radius_px)),
                                          Fixed(middle + cv::Point2d(-radius_px, 0.0))};
  const cv::Scalar dark(0, 0, 0);
  cv::polylines(pixels_, corners, true, dark, 5, cv::LINE_AA, kShift);
  if (is_filled) cv::fillConvexPoly(pixels_, corners, ToScalar(color), cv::LINE_AA, kShift);
  cv::polylines(pixels_, corners, true, ToScalar(color), 2, cv::LINE_AA, kShift);
}

void Canvas::Box(const cv::Rect& where, const Rgb& color) {
  cv::rectangle(pixels_, where, ToScalar(color), cv::FILLED);
}

void Canvas::Text(std::string_view text, cv::Point baseline, double height_px, const Rgb& color) {
  cv::putText(pixels_,
              AsciiText(text),
              baseline,
              kFont,
              height_px / kLetter_px,
              ToScalar(color),
              Stroke(height_px),
              cv::LINE_AA);
}

cv::Rect Canvas::Label(std::string_view text,
                       cv::Point corner,
                       double height_px,
                       const Rgb& color) {
  const int margin = static_cast<int>(std::lround(0.6 * height_px));
  const cv::Size size = SizeOfText(text, height_px);
  const cv::Rect ground(
      corner.x, corner.y, size.width + 2 * margin, static_cast<int>(height_px) + 2 * margin);
  Blend(0.65, [&](Canvas& layer) { layer.Box(ground, Rgb{0, 0, 0}); });
  Text(
      text, {corner.x + margin, corner.y + margin + static_cast<int>(height_px)}, height_px, color);
  return ground;
}

void Canvas::Blend(double opacity, const std::function<void(Canvas&)>& draw) {
  Canvas layer(pixels_.clone());
  draw(layer);
  cv::addWeighted(layer.pixels_, opacity, pixels_, 1.0 - opacity, 0.0, pixels_);
}

absl::StatusOr<std::string> Canvas::Png() const { return EncodePng(pixels_); }

absl::StatusOr<std::string> Canvas::Jpeg(int quality) const { return EncodeJpeg(pixels_, quality); }

}  // namespace orbweave
