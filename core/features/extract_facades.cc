// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/extract_facades.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <vector>

#include "core/features/select_spread.h"
#include "core/features/sift/streaming_sift.h"
#include "core/features/sigma_of_scale.h"
#include "core/features/useful_places.h"
#include "core/geometry/facade_view.h"

namespace orbweave {
namespace {

constexpr int kWidest_px = 4096;
/// Views of narrower ones are smaller than the coarsest octave (PlanScaleSpace).
constexpr int kNarrowest_px = 128;
/// Columns beyond the seam that interpolation reads.
constexpr int kSeam_px = 2;
/// Standard deviations that the samples of a descriptor reach (sift/octave_plan.h): 8.5 x 15/16
/// steps, and half as much again in the corners.
constexpr float kReachInSigmas = 8.0F;

/// Where the pixels of the first view lie in the panorama; those of view k lie k eighths of its
/// width further on.
struct ViewMap {
  cv::Mat columns{};
  cv::Mat rows{};
};

ViewMap MapOfFirst(const FacadeView& view, const EquirectangularCamera& camera) {
  ViewMap map{cv::Mat(view.Height(), view.Width(), CV_32F),
              cv::Mat(view.Height(), view.Width(), CV_32F)};
  for (int y = 0; y < map.columns.rows; ++y) {
    for (int x = 0; x < map.columns.cols; ++x) {
      const Eigen::Vector2d pixel =
          camera.PixelFromBearing(view.BearingFromPixel({x + 0.5, y + 0.5}));
      map.columns.at<float>(y, x) = static_cast<float>(pixel.x() - 0.5);
      map.rows.at<float>(y, x) = static_cast<float>(pixel.y() - 0.5);
    }
  }
  return map;
}

/// The pixels of a view of a panorama that was continued by kSeam_px columns.
cv::Mat Look(const cv::Mat& continued, const ViewMap& map, int number, int interpolation) {
  const auto width = static_cast<float>(continued.cols - kSeam_px);
  cv::Mat columns = map.columns + width * static_cast<float>(number) / kNumFacadeViews;
  columns.forEach<float>([width](float& column, const int*) {
    if (column >= width) column -= width;
    if (column < 0.0F) column += width;
  });
  cv::Mat view;
  cv::remap(continued, view, columns, map.rows, interpolation, cv::BORDER_REPLICATE);
  return view;
}

cv::Mat Continued(const cv::Mat& panorama) {
  cv::Mat continued;
  cv::copyMakeBorder(panorama, continued, 0, 0, 0, kSeam_px, cv::BORDER_WRAP);
  return continued;
}

cv::Mat ReducedTo(const cv::Mat& panorama, int width, int interpolation) {
  if (panorama.empty() || panorama.cols <= width) return panorama;
  cv::Mat reduced;
  cv::resize(panorama, reduced, cv::Size(width, width / 2), 0, 0, interpolation);
  return reduced;
}

/// Features of one view after the other. `panorama` may be a reduced one, of which a pixel is
/// `pixel` of those of the features.
class FacadeExtractor {
 public:
  FacadeExtractor(const cv::Mat& panorama,
                  const cv::Mat& ignored,
                  double pixel,
                  const ExtractOptions& options)
      : options_(options),
        camera_{panorama.cols, panorama.rows},
        pixel_(pixel),
        focal_px_(panorama.cols / (2.0 * std::numbers::pi)),
        map_(MapOfFirst({0, focal_px_}, camera_)),
        continued_(Continued(panorama)),
        ignored_(ignored.empty() ? ignored : Continued(ignored)) {}

  absl::Status Append(int number, const StageContext& context, Features& features) {
    const cv::Mat seen = Look(continued_, map_, number, cv::INTER_LINEAR);
    StreamingSift sift(
        seen,
        {.thresholds = {.contrast = options_.contrast_threshold, .edge = options_.edge_threshold},
         .first_y = 0.0,
         .end_y = static_cast<double>(seen.rows)});
    ORBWEAVE_RETURN_IF_ERROR(sift.Detect(context));
    ORBWEAVE_ASSIGN_OR_RETURN(std::vector<internal::DescribedPosition> described,
                              sift.Describe(Choose(sift, number), context));
    KeepLargest(sift, described);
    for (const internal::DescribedPosition& each : described) {
      Keypoint in_view = sift.KeypointOf(each.position);
      in_view.orientation_rad = each.orientation_rad;
      features.colors.push_back(ColorAt(seen, in_view));
      AddKeypoint(InPanorama(in_view, number), features);
      features.descriptors.insert(
          features.descriptors.end(), each.descriptor.begin(), each.descriptor.end());
      features.view.push_back(static_cast<uint8_t>(number + 1));
    }
    return absl::OkStatus();
  }

 private:
  /// The largest first.
  void KeepLargest(const StreamingSift& sift,
                   std::vector<internal::DescribedPosition>& described) const {
    std::ranges::sort(described, {}, [&](const internal::DescribedPosition& each) {
      const Keypoint at = sift.KeypointOf(each.position);
      return std::tuple(-at.scale_px, at.y_px, at.x_px, each.orientation_rad);
    });
    const auto most = static_cast<size_t>(options_.facade_features);
    if (described.size() > most) described.resize(most);
  }

  void AddKeypoint(const Keypoint& in_panorama, Features& features) const {
    features.sigma_rad.push_back(
        static_cast<float>(camera_.AngleFromPixels(SigmaOfScale_px(in_panorama.scale_px))));
    const auto pixel = static_cast<float>(pixel_);
    features.keypoints.push_back({pixel * in_panorama.x_px,
                                  pixel * in_panorama.y_px,
                                  pixel * in_panorama.scale_px,
                                  in_panorama.orientation_rad});
  }

  [[nodiscard]] Keypoint InPanorama(const Keypoint& in_view, int number) const {
    const FacadeView view{number, focal_px_};
    const Eigen::Vector2d at(in_view.x_px, in_view.y_px);
    const Eigen::Vector2d pixel = camera_.PixelFromBearing(view.BearingFromPixel(at));
    return {static_cast<float>(pixel.x()),
            static_cast<float>(pixel.y()),
            static_cast<float>(in_view.scale_px * view.ScaleAt(at)),
            in_view.orientation_rad};
  }

  /// Whether the view shows all that its descriptor is made of.
  [[nodiscard]] bool IsWhole(const Keypoint& in_view, const cv::Size& size) const {
    const float reach = kReachInSigmas * in_view.scale_px;
    return in_view.x_px >= reach && in_view.y_px >= reach &&
           in_view.x_px <= static_cast<float>(size.width) - reach &&
           in_view.y_px <= static_cast<float>(size.height) - reach;
  }

  [[nodiscard]] std::vector<uint32_t> Choose(const StreamingSift& sift, int number) const {
    const cv::Mat ignored =
        ignored_.empty() ? cv::Mat() : Look(ignored_, map_, number, cv::INTER_NEAREST);
    const UsefulPlaces places(map_.columns.size(), 90.0, ignored);
    std::vector<ScoredKeypoint> scored;
    std::vector<uint32_t> numbers;
    for (size_t i = 0; i < sift.num_positions(); ++i) {
      const Keypoint in_view = sift.KeypointOf(i);
      if (!IsWhole(in_view, map_.columns.size()) || !places.Contain(in_view)) continue;
      scored.push_back({InPanorama(in_view, number), sift.ResponseOf(i)});
      numbers.push_back(static_cast<uint32_t>(i));
    }
    std::vector<uint32_t> chosen;
    for (const uint32_t i :
         SelectSpread(camera_, scored, static_cast<size_t>(options_.facade_features)))
      chosen.push_back(numbers[i]);
    return chosen;
  }

  [[nodiscard]] static Rgb ColorAt(const cv::Mat& seen, const Keypoint& in_view) {
    const auto& bgr =
        seen.at<cv::Vec3b>(std::clamp(static_cast<int>(in_view.y_px), 0, seen.rows - 1),
                           std::clamp(static_cast<int>(in_view.x_px), 0, seen.cols - 1));
    return {.r = bgr[2], .g = bgr[1], .b = bgr[0]};
  }

  const ExtractOptions& options_;
  EquirectangularCamera camera_{};
  double pixel_ = 1.0;
  double focal_px_ = 0.0;
  ViewMap map_{};
  cv::Mat continued_{};
  cv::Mat ignored_{};
};

}  // namespace

absl::Status AppendFacadeFeatures(const cv::Mat& panorama,
                                  const cv::Mat& ignored,
                                  const ExtractOptions& options,
                                  const StageContext& context,
                                  Features& features) {
  if (panorama.cols < kNarrowest_px) return absl::OkStatus();
  const cv::Mat reduced = ReducedTo(panorama, kWidest_px, cv::INTER_AREA);
  const double pixel = static_cast<double>(panorama.cols) / reduced.cols;
  FacadeExtractor extractor(
      reduced, ReducedTo(ignored, reduced.cols, cv::INTER_NEAREST), pixel, options);
  features.view.assign(features.size(), 0);
  for (int number = 0; number < kNumFacadeViews; ++number)
    ORBWEAVE_RETURN_IF_ERROR(extractor.Append(number, context, features));
  return absl::OkStatus();
}

}  // namespace orbweave
