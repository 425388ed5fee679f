// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/lay_panorama.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "core/features/decode_panorama.h"

namespace orbweave {
namespace {

constexpr int kWidestToDecode_px = 65536;  // as ExtractOptions allows at most
constexpr double kBrightness = 0.72;
constexpr Rgb kGround = {22, 24, 28};
constexpr Rgb kGrid = {60, 64, 72};
constexpr Rgb kTitle = {255, 255, 255};
constexpr Rgb kText = {205, 210, 218};
constexpr int kTitle_px = 19;
constexpr int kText_px = 14;
constexpr int kMargin_px = 18;
constexpr int kTitleGap_px = 6;
constexpr int kLine_px = 26;  // from one line of text to the next

/// Lines every 30 degrees of azimuth and latitude: they stand for a photograph.
void DrawGrid(const LaidPanorama& panorama, Canvas& canvas) {
  canvas.Box({0, panorama.top_px, panorama.width_px, panorama.Height()}, kGround);
  for (int i = 0; i <= 12; ++i) {
    const double x = panorama.width_px * i / 12.0;
    canvas.Line({x, static_cast<double>(panorama.top_px)},
                {x, static_cast<double>(panorama.top_px + panorama.Height())},
                kGrid);
  }
  for (int i = 0; i <= 6; ++i) {
    const double y = panorama.top_px + panorama.Height() * i / 6.0;
    canvas.Line({0.0, y}, {static_cast<double>(panorama.width_px), y}, kGrid);
  }
}

/// Azimuths along the lower border: the middle of a panorama looks along 0.
void DrawAzimuths(const LaidPanorama& panorama, Canvas& canvas) {
  for (const int degrees : {-90, 0, 90}) {
    const double x = panorama.width_px * (degrees / 360.0 + 0.5);
    const double foot = panorama.top_px + panorama.Height();
    canvas.Line({x, foot - 10.0}, {x, foot}, kTitle, 2);
    const std::string text = std::to_string(degrees) + " deg";
    const int half = SizeOfText(text, 11).width / 2;
    canvas.Text(text, {static_cast<int>(x) - half, static_cast<int>(foot) - 16}, 11, kText);
  }
}

/// A line of text on a picture.
struct HeadLine {
  std::string text{};
  int baseline = 0;  ///< below the first row
  bool is_title = false;
};

/// The front of `text` that fits into the width, whole words unless one alone is wider.
std::string_view FirstLine(std::string_view text, double height_px) {
  const int room = kPictureWidth_px - 2 * kMargin_px;
  std::string_view line = text;
  while (SizeOfText(line, height_px).width > room) {
    const size_t space = line.rfind(' ');
    if (space == std::string_view::npos || space == 0) break;
    line = line.substr(0, space);
  }
  return line;
}

std::vector<HeadLine> BreakHeadlines(std::span<const std::string> texts) {
  std::vector<HeadLine> lines;
  int baseline = kMargin_px + kTitle_px;
  for (size_t i = 0; i < texts.size(); ++i) {
    const bool is_title = i == 0;
    std::string_view rest = texts[i];
    do {
      const std::string_view line = FirstLine(rest, is_title ? kTitle_px : kText_px);
      lines.push_back({std::string(line), baseline, is_title});
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
      baseline += kLine_px + (is_title ? kTitleGap_px : 0);
    } while (!rest.empty());
  }
  return lines;
}

}  // namespace

LaidPanorama LayPanorama(const PictureImage& image, int top_px, Canvas& canvas) {
  const LaidPanorama laid{image.camera, canvas.Width(), top_px};
  const absl::StatusOr<cv::Mat> pixels = DecodePanorama(image.encoded, kWidestToDecode_px);
  if (pixels.ok()) {
    cv::Mat scaled;
    const cv::Size size(laid.width_px, laid.Height());
    const bool shrinks = pixels->cols > laid.width_px;
    cv::resize(*pixels, scaled, size, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_CUBIC);
    scaled.convertTo(canvas.Pixels()(cv::Rect(cv::Point(0, top_px), size)), CV_8UC3, kBrightness);
  } else {
    DrawGrid(laid, canvas);
  }
  DrawAzimuths(laid, canvas);
  return laid;
}

void DrawCurves(const std::vector<PixelCurve>& curves,
                const LaidPanorama& panorama,
                const Rgb& color,
                int thickness,
                Canvas& canvas) {
  for (const PixelCurve& curve : curves) {
    std::vector<cv::Point2d> points;
    for (const Eigen::Vector2d& pixel : curve) points.push_back(panorama.At(pixel));
    canvas.Curve(points, color, thickness);
  }
}

int HeightOfHeadlines(std::span<const std::string> texts) {
  const std::vector<HeadLine> lines = BreakHeadlines(texts);
  return lines.empty() ? 0 : lines.back().baseline + 2 * kMargin_px;
}

void WriteHeadlines(std::span<const std::string> texts, int top_px, Canvas& canvas) {
  for (const HeadLine& line : BreakHeadlines(texts)) {
    canvas.Text(line.text,
                {kMargin_px, top_px + line.baseline},
                line.is_title ? kTitle_px : kText_px,
                line.is_title ? kTitle : kText);
  }
}

}  // namespace orbweave
