// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/draw_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/quantile.h"
#include "core/drawing/color_scale.h"
#include "core/drawing/lay_panorama.h"
#include "core/drawing/spread_choice.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr int kGap_px = 28;
constexpr int kLegend_px = 58;
constexpr size_t kNumCurves = 6;
constexpr size_t kMostLines = 600;        // more hide the panoramas that they cross
constexpr double kFarFromEpipole = 0.94;  // |cos| of 20 degrees: nearer curves say nothing
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
constexpr Rgb kGrey = {185, 188, 192};
constexpr Rgb kWhite = {255, 255, 255};
constexpr Rgb kText = {205, 210, 218};
constexpr Rgb kRejected = {230, 140, 200};

/// Draws the line between both ends the short way round: over the seam it leaves at one side and
/// comes back at the other.
void DrawMatch(cv::Point2d a, cv::Point2d b, const Rgb& color, Canvas& canvas) {
  const double width = canvas.Width();
  double shift = 0.0;
  if (b.x - a.x > 0.5 * width) shift = -width;
  if (a.x - b.x > 0.5 * width) shift = width;
  canvas.Line(a, {b.x + shift, b.y}, color);
  if (shift != 0.0) canvas.Line({a.x - shift, a.y}, b, color);
}

/// The angle that most inliers stay below: the end of the scale.
double ScaleEnd(const std::vector<PictureMatch>& inliers) {
  if (inliers.empty()) return 0.0;
  std::vector<double> angles;
  for (const PictureMatch& match : inliers) angles.push_back(match.angle_rad);
  const size_t high = angles.size() * 19 / 20;
  return ValueOfRank(std::move(angles), high);
}

class PairDrawing {
 public:
  explicit PairDrawing(const PairPicture& picture)
      : picture_(picture),
        top_px_(HeightOfHeadlines(picture.headlines)),
        canvas_(kPictureWidth_px, top_px_ + kPictureWidth_px + kGap_px + kLegend_px),
        scale_end_rad_(ScaleEnd(picture.inliers)) {}

  absl::StatusOr<std::string> Draw() {
    WriteHeadlines(picture_.headlines, 0, canvas_);
    a_ = LayPanorama(picture_.a, top_px_, canvas_);
    b_ = LayPanorama(picture_.b, top_px_ + a_.Height() + kGap_px, canvas_);
    DrawMatches();
    DrawEpipolarCurves();
    DrawEpipoles();
    canvas_.Label("A  " + picture_.a.name, {12, a_.top_px + 12}, 16, kWhite);
    canvas_.Label("B  " + picture_.b.name, {12, b_.top_px + 12}, 16, kWhite);
    DrawLegend();
    return canvas_.Png();
  }

 private:
  [[nodiscard]] Rgb ColorOf(const PictureMatch& match) const {
    if (!picture_.is_verified) return kRejected;
    return ColorOnScale(scale_end_rad_ > 0.0 ? match.angle_rad / scale_end_rad_ : 0.0);
  }

  /// Lines are drawn for each so-many-th inlier.
  [[nodiscard]] size_t LineStep() const { return 1 + picture_.inliers.size() / kMostLines; }

  void DrawMatches() {
    canvas_.Blend(0.45, [&](Canvas& layer) {
      for (const PictureMatch& match : picture_.outliers)
        DrawMatch(a_.At(match.a_px), b_.At(match.b_px), kGrey, layer);
    });
    const double num_lines = static_cast<double>(picture_.inliers.size() / LineStep());
    const double opacity = std::clamp(0.9 - 0.1 * std::log2(1.0 + num_lines / 25.0), 0.3, 0.8);
    canvas_.Blend(opacity, [&](Canvas& layer) {
      for (size_t i = 0; i < picture_.inliers.size(); i += LineStep()) {
        const PictureMatch& match = picture_.inliers[i];
        DrawMatch(a_.At(match.a_px), b_.At(match.b_px), ColorOf(match), layer);
      }
    });
    for (const PictureMatch& match : picture_.outliers) {
      canvas_.Dot(a_.At(match.a_px), 1.4, kGrey);
      canvas_.Dot(b_.At(match.b_px), 1.4, kGrey);
    }
    for (const PictureMatch& match : picture_.inliers) {
      canvas_.Dot(a_.At(match.a_px), 2.4, ColorOf(match));
      canvas_.Dot(b_.At(match.b_px), 2.4, ColorOf(match));
    }
  }

  /// Inliers whose curves are drawn: far from each other and from the epipoles.
  [[nodiscard]] std::vector<PictureMatch> CurveMatches() const {
    std::vector<PictureMatch> eligible;
    std::vector<Vector3d> bearings;
    for (const PictureMatch& match : picture_.inliers) {
      const Vector3d bearing = picture_.a.camera.BearingFromPixel(match.a_px);
      if (std::abs(bearing.dot(*picture_.baseline_in_a)) > kFarFromEpipole) continue;
      eligible.push_back(match);
      bearings.push_back(bearing);
    }
    std::vector<PictureMatch> chosen;
    for (const uint32_t i : ChooseSpread(bearings, kNumCurves)) chosen.push_back(eligible[i]);
    return chosen;
  }

  /// The great circle through `epipole` and `vanishing`, bold between them.
  void DrawEpipolarCurve(const LaidPanorama& panorama,
                         const Vector3d& epipole,
                         const Vector3d& vanishing,
                         const Rgb& color) {
    const double cosine = std::clamp(epipole.dot(vanishing), -1.0, 1.0);
    const Vector3d along = (vanishing - cosine * epipole).normalized();
    const double length_rad = std::acos(cosine);
    const auto circle = SphereCurve(panorama.camera, epipole, along, 2.0 * std::numbers::pi);
    canvas_.Blend(0.45, [&](Canvas& layer) { DrawCurves(circle, panorama, color, 1, layer); });
    const auto half = SphereCurve(panorama.camera, epipole, along, length_rad);
    DrawCurves(half, panorama, Rgb{0, 0, 0}, 4, canvas_);
    DrawCurves(half, panorama, color, 2, canvas_);
  }

  void DrawChosen(cv::Point2d at, size_t number, const Rgb& color) {
    canvas_.Ring(at, 8.0, Rgb{0, 0, 0}, 5);
    canvas_.Ring(at, 8.0, color, 2);
    canvas_.Label(std::to_string(number + 1),
                  {static_cast<int>(at.x) + 10, static_cast<int>(at.y) - 24},
                  13,
                  color);
  }

  void DrawEpipolarCurves() {
    if (!picture_.b_from_a || !picture_.baseline_in_a) return;
    const Eigen::Quaterniond& R = *picture_.b_from_a;
    const Vector3d& b_in_a = *picture_.baseline_in_a;
    const Vector3d a_in_b = -(R * b_in_a);
    const std::vector<PictureMatch> chosen = CurveMatches();
    for (size_t i = 0; i < chosen.size(); ++i) {
      const Vector3d ray_a = picture_.a.camera.BearingFromPixel(chosen[i].a_px);
      const Vector3d ray_b = picture_.b.camera.BearingFromPixel(chosen[i].b_px);
      DrawEpipolarCurve(a_, b_in_a, R.conjugate() * ray_b, ColorOfNumber(i));
      DrawEpipolarCurve(b_, a_in_b, R * ray_a, ColorOfNumber(i));
    }
    for (size_t i = 0; i < chosen.size(); ++i) {
      DrawChosen(a_.At(chosen[i].a_px), i, ColorOfNumber(i));
      DrawChosen(b_.At(chosen[i].b_px), i, ColorOfNumber(i));
    }
  }

  void DrawEpipole(const LaidPanorama& panorama,
                   const Vector3d& bearing,
                   const std::string& label,
                   bool is_toward) {
    const cv::Point2d at = panorama.AtBearing(bearing);
    canvas_.Diamond(at, 12.0, kWhite, is_toward);
    const int width = SizeOfText(label, 13).width + 20;
    const bool is_left = at.x + 18 + width > canvas_.Width();
    canvas_.Label(
        label,
        {static_cast<int>(at.x) + (is_left ? -18 - width : 18), static_cast<int>(at.y) - 14},
        13,
        kWhite);
  }

  void DrawEpipoles() {
    if (!picture_.b_from_a || !picture_.baseline_in_a) return;
    const Vector3d& b_in_a = *picture_.baseline_in_a;
    const Vector3d a_in_b = -(*picture_.b_from_a * b_in_a);
    DrawEpipole(a_, b_in_a, "B stands here", true);
    DrawEpipole(a_, -b_in_a, "away from B", false);
    DrawEpipole(b_, a_in_b, "A stands here", true);
    DrawEpipole(b_, -a_in_b, "away from A", false);
  }

  void DrawLegend() {
    const int foot = canvas_.Height();
    const int baseline = foot - 22;
    int x = 18;
    const auto say = [&](const std::string& text) {
      canvas_.Text(text, {x, baseline}, 13, kText);
      x += SizeOfText(text, 13).width + 34;
    };
    const auto sample = [&](const Rgb& color) {
      canvas_.Line({static_cast<double>(x), baseline - 6.0}, {x + 40.0, baseline - 6.0}, color, 2);
      x += 50;
    };
    sample(kGrey);
    say(std::to_string(picture_.outliers.size()) + " matches that do not fit");
    if (picture_.is_verified) {
      DrawScale(x, baseline);
      x += 220;
      say(std::to_string(picture_.inliers.size()) + " inliers by the angle at their point, 0 to " +
          std::to_string(std::lround(scale_end_rad_ * kDegreesPerRadian)) + " deg (far to near)" +
          StepText());
    } else {
      sample(kRejected);
      say(std::to_string(picture_.inliers.size()) + " fit the best geometry, not accepted" +
          StepText());
    }
    if (picture_.baseline_in_a) say("rings and curves: where the other panorama's ray must lie");
  }

  [[nodiscard]] std::string StepText() const {
    return LineStep() == 1 ? "" : ", a line for one in " + std::to_string(LineStep());
  }

  void DrawScale(int left, int baseline) {
    constexpr int kWidth = 210;
    for (int i = 0; i < kWidth; ++i) {
      canvas_.Box({left + i, baseline - 13, 1, 14}, ColorOnScale(static_cast<double>(i) / kWidth));
    }
  }

  const PairPicture& picture_;
  int top_px_;
  Canvas canvas_;
  double scale_end_rad_;
  LaidPanorama a_{};
  LaidPanorama b_{};
};

}  // namespace

absl::StatusOr<std::string> DrawPair(const PairPicture& picture) {
  return PairDrawing(picture).Draw();
}

}  // namespace orbweave
