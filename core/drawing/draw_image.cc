// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/draw_image.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/drawing/color_scale.h"
#include "core/drawing/lay_panorama.h"

namespace orbweave {
namespace {

constexpr int kLegend_px = 58;
constexpr Rgb kGrey = {185, 188, 192};
constexpr Rgb kWhite = {255, 255, 255};
constexpr Rgb kText = {205, 210, 218};

/// Features of one colour.
struct FeatureClass {
  double from = 0.0;  ///< up to the next one's
  const char* label = "";
};

constexpr std::array<FeatureClass, 5> kLengths = {
    {{2, "2"}, {3, "3"}, {4, "4-5"}, {6, "6-9"}, {10, "10 and more panoramas"}}};
constexpr std::array<FeatureClass, 5> kResiduals = {
    {{0, "0-0.5"}, {0.5, "0.5-1"}, {1, "1-2"}, {2, "2-4"}, {4, "more than 4 px"}}};

class ImageDrawing {
 public:
  explicit ImageDrawing(const ImagePicture& picture)
      : picture_(picture),
        by_length_(picture.colors == FeatureColors::kTrackLength),
        top_px_(HeightOfHeadlines(picture.headlines)),
        canvas_(kPictureWidth_px, top_px_ + kPictureWidth_px / 2 + kLegend_px) {}

  absl::StatusOr<std::string> Draw() {
    WriteHeadlines(picture_.headlines, 0, canvas_);
    laid_ = LayPanorama(picture_.image, top_px_, canvas_);
    canvas_.Blend(0.6, [&](Canvas& layer) {
      for (const Eigen::Vector2d& at_px : picture_.unused_px)
        layer.Dot(laid_.At(at_px), 1.3, kGrey);
    });
    DrawTracked();
    DrawDirections();
    DrawLegend();
    return canvas_.Png();
  }

 private:
  [[nodiscard]] const std::array<FeatureClass, 5>& Classes() const {
    return by_length_ ? kLengths : kResiduals;
  }

  [[nodiscard]] size_t ClassOf(const PictureFeature& feature) const {
    const double value = by_length_ ? feature.track_length : feature.residual_px;
    size_t found = 0;
    while (found + 1 < Classes().size() && value >= Classes()[found + 1].from) ++found;
    return found;
  }

  static Rgb ColorOfClass(size_t number) {
    return ColorOnScale(static_cast<double>(number) / (kLengths.size() - 1));
  }

  /// Those of the last class lie on top.
  void DrawTracked() {
    for (size_t number = 0; number < Classes().size(); ++number) {
      for (const PictureFeature& feature : picture_.tracked) {
        if (ClassOf(feature) != number) continue;
        const cv::Point2d at = laid_.At(feature.at_px);
        canvas_.Dot(at, 3.4, Rgb{0, 0, 0});
        canvas_.Dot(at, 2.6, ColorOfClass(number));
        ++counts_[number];
      }
    }
  }

  /// Labels move down until they hide no other one.
  void DrawDirections() {
    std::vector<cv::Rect> taken;
    for (const PictureDirection& direction : picture_.directions) {
      const cv::Point2d at = laid_.AtBearing(direction.bearing);
      canvas_.Diamond(at, 9.0, kWhite, true);
      const cv::Size size = SizeOfText(direction.label, 12);
      cv::Rect place(static_cast<int>(at.x) + 14, static_cast<int>(at.y) - 13, size.width + 16, 28);
      if (place.br().x > canvas_.Width()) place.x = static_cast<int>(at.x) - 14 - place.width;
      const auto hides = [&](const cv::Rect& other) { return (other & place).area() > 0; };
      while (std::any_of(taken.begin(), taken.end(), hides) &&
             place.br().y + place.height < canvas_.Height()) {
        place.y += place.height;
      }
      taken.push_back(place);
      const double side = place.x > at.x ? place.x : place.br().x;
      canvas_.Line(at, {side, place.y + 0.5 * place.height}, kWhite);
      canvas_.Label(direction.label, place.tl(), 12, kWhite);
    }
  }

  void DrawLegend() {
    const int baseline = canvas_.Height() - 22;
    int x = 18;
    const auto say = [&](const std::string& text, int gap) {
      canvas_.Text(text, {x, baseline}, 13, kText);
      x += SizeOfText(text, 13).width + gap;
    };
    const auto dot = [&](const Rgb& color, double radius_px) {
      canvas_.Dot({x + 5.0, baseline - 6.0}, radius_px, color);
      x += 18;
    };
    dot(kGrey, 2.5);
    say(std::to_string(picture_.unused_px.size()) + " features in no track", 34);
    say(by_length_ ? "seen by" : "residual", 16);
    for (size_t number = 0; number < Classes().size(); ++number) {
      dot(ColorOfClass(number), 5.0);
      say(std::string(Classes()[number].label) + " (" + std::to_string(counts_[number]) + ")", 22);
    }
    if (picture_.directions.empty()) return;
    canvas_.Diamond({x + 8.0, baseline - 6.0}, 7.0, kWhite, true);
    x += 24;
    say("where verified partners stand", 0);
  }

  const ImagePicture& picture_;
  bool by_length_;
  int top_px_;
  Canvas canvas_;
  LaidPanorama laid_{};
  std::array<size_t, 5> counts_{};
};

}  // namespace

absl::StatusOr<std::string> DrawImage(const ImagePicture& picture) {
  return ImageDrawing(picture).Draw();
}

}  // namespace orbweave
