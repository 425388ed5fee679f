// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/check_depths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dense/equiangular_raster.h"
#include "core/dense/remove_speckles.h"
#include "core/dense/shared_errors.h"
#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

constexpr float kSigmas = 3.0F;
constexpr float kLeastTolerance = 0.01F;  // of the range
constexpr float kMaxReprojection_px = 1.0F;
/// Own sigmas weigh as much as four ranges that scatter as they say. Of 1, 2, 4 and infinitely
/// many, four gave sigmas nearest to errors on streets 11 and 12 (`bench_depth --seed N`).
constexpr float kClaimWeight = 4.0F;
/// Interpolation draws all pixels of a surface alike: medians of the errors of whole walls and
/// roads scatter by so much in parallax (plain streets 11, steps of 2.5 and 8 m).
constexpr float kBias_px = 0.05F;
constexpr float kLeastSine = 0.07F;    // 4 degrees
constexpr float kAlongTheRay = 1e-3F;  // a sine that tells nothing of the range
/// From farther away, in ranges of the reference, a panorama need not have found the point.
constexpr float kMuchFarther = 2.0F;
/// What stands in front by a fifth of the distance hides the point; what is nearer denies it.
constexpr float kHides = 0.8F;

/// Pixel of the raster that a vector of the camera frame falls on, in single precision.
class PixelLookup {
 public:
  explicit PixelLookup(int face_px) : raster_{face_px} {
    for (int face = 0; face < kCubeFaces; ++face)
      faces_[static_cast<size_t>(face)] = FaceFromCamera(face).cast<float>();
  }

  [[nodiscard]] size_t Find(const Eigen::Vector3f& v) const {
    const int face = FaceOf(v.cast<double>());
    const Eigen::Vector3f in_face = faces_[static_cast<size_t>(face)] * v;
    return raster_.Index(face, Pixel(in_face.y() / in_face.z()), Pixel(in_face.x() / in_face.z()));
  }

 private:
  /// Arc tangent for [-1, 1] within 1e-5 (Abramowitz and Stegun 4.4.49).
  [[nodiscard]] int Pixel(float t) const {
    const float s = t * t;
    const float angle =
        t *
        (0.9998660F + s * (-0.3302995F + s * (0.1801410F + s * (-0.0851330F + s * 0.0208351F))));
    const auto half = 0.5F * static_cast<float>(raster_.face_px);
    const auto pixel = static_cast<int>(half + angle * (half / 0.78539816F));
    return std::clamp(pixel, 0, raster_.face_px - 1);
  }

  EquiangularRaster raster_;
  std::array<Eigen::Matrix3f, kCubeFaces> faces_{};
};

/// Bearings of the pixels of a raster. Those of one face, turned: faces differ by the order and the
/// signs of coordinates alone.
class PixelBearings {
 public:
  explicit PixelBearings(const EquiangularRaster& raster) {
    for (int face = 0; face < kCubeFaces; ++face)
      turns_[static_cast<size_t>(face)] = FaceFromCamera(face).transpose().cast<float>();
    in_face_.reserve(raster.NumPixels() / kCubeFaces);
    for (int row = 0; row < raster.face_px; ++row) {
      for (int column = 0; column < raster.face_px; ++column) {
        const Eigen::Vector3d bearing = raster.BearingFromPixel(0, row + 0.5, column + 0.5);
        in_face_.emplace_back((FaceFromCamera(0) * bearing).cast<float>());
      }
    }
  }

  [[nodiscard]] Eigen::Vector3f Of(size_t pixel) const {
    return turns_[pixel / in_face_.size()] * in_face_[pixel % in_face_.size()];
  }

 private:
  std::array<Eigen::Matrix3f, kCubeFaces> turns_{};
  std::vector<Eigen::Vector3f> in_face_{};
};

struct Neighbour {
  const DepthMap* map;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  Eigen::Vector3f centre;  // in the reference's frame
};

/// What the neighbours say of one point.
struct Votes {
  int asked = 0;  // have a depth there, from no much farther away, that hides nothing
  int agreeing = 0;
  int seen_through = 0;
  float sine = 0.0F;                                               // of the largest parallax
  float least_m_per_rad = std::numeric_limits<float>::infinity();  // of an angle seen by one

  // Sums over own and agreeing ranges, less the own one.
  float weight = 0.0F;       // 1 / sigma^2
  float weighted_m = 0.0F;   // range / sigma^2
  float weighted_m2 = 0.0F;  // range^2 / sigma^2

  void Add(float range_m, float variance) {
    weight += 1.0F / variance;
    weighted_m += range_m / variance;
    weighted_m2 += range_m * range_m / variance;
  }
  [[nodiscard]] float Mean() const { return weighted_m / weight; }
  /// `bias_rad`: of a direction, common to all.
  [[nodiscard]] float Sigma(float bias_rad) const {
    const auto others = static_cast<float>(agreeing);
    const float scatter = std::max(0.0F, weighted_m2 - weighted_m * weighted_m / weight);
    const float factor =
        (kClaimWeight + scatter / (1.0F - kSharedVariance)) / (kClaimWeight + others);
    const float of_one = (others + 1.0F) / weight;
    const float bias_m = agreeing > 0 ? bias_rad * least_m_per_rad : 0.0F;
    return std::sqrt(factor * of_one * VarianceOfMean(others + 1.0F) + bias_m * bias_m);
  }
};

class Checker {
 public:
  Checker(const DepthMap& own, const std::vector<NeighbourMap>& neighbours)
      : own_(own),
        bearings_({own.face_px}),
        lookup_(own.face_px),
        pixel_rad_(1.5707963F / static_cast<float>(own.face_px)) {
    for (const NeighbourMap& neighbour : neighbours) {
      if (neighbour.map == nullptr || neighbour.map->face_px != own.face_px) continue;
      const Rigid3& pose = neighbour.neighbour_from_reference;
      neighbours_.push_back({neighbour.map,
                             pose.rotation.toRotationMatrix().cast<float>(),
                             pose.translation.cast<float>(),
                             pose.Centre().cast<float>()});
    }
  }

  [[nodiscard]] size_t NumNeighbours() const { return neighbours_.size(); }
  [[nodiscard]] float PixelAngle() const { return pixel_rad_; }

  [[nodiscard]] Votes Ask(size_t pixel) const {
    const Eigen::Vector3f bearing = bearings_.Of(pixel);
    const float range_m = own_.range_m[pixel];
    const float own_variance = own_.sigma_m[pixel] * own_.sigma_m[pixel];
    Votes votes;
    votes.Add(0.0F, own_variance);
    for (const Neighbour& neighbour : neighbours_)
      Ask(neighbour, range_m, own_variance, bearing, votes);
    return votes;
  }

 private:
  void Ask(const Neighbour& neighbour,
           float range_m,
           float own_variance,
           const Eigen::Vector3f& bearing,
           Votes& votes) const {
    const Eigen::Vector3f there = neighbour.rotation * (range_m * bearing) + neighbour.translation;
    const size_t at = lookup_.Find(there);
    const float its_range_m = neighbour.map->range_m[at];
    if (!(its_range_m > 0.0F)) return;
    const float distance_m = there.norm();
    if (distance_m < kMuchFarther * range_m && its_range_m > kHides * distance_m) ++votes.asked;
    const float sigma_m = neighbour.map->sigma_m[at];
    const float tolerance_m = std::max(kSigmas * std::sqrt(own_variance + sigma_m * sigma_m),
                                       kLeastTolerance * distance_m);
    const Eigen::Vector3f to_source = bearing * range_m - neighbour.centre;
    const float sine = bearing.cross(to_source).norm() / distance_m;
    const Eigen::Vector3f normal = DecodeNormal(neighbour.map->normals[at]);
    const float here = normal.dot(bearings_.Of(at));
    const float surface_m = SurfaceAlong(normal, here, its_range_m, there / distance_m);
    const float behind_m = surface_m - distance_m;
    const float beside_px = std::abs(behind_m) * sine / (range_m * pixel_rad_);
    if (std::abs(behind_m) < tolerance_m && beside_px < kMaxReprojection_px) {
      ++votes.agreeing;
      votes.sine = std::max(votes.sine, sine);
      votes.least_m_per_rad =
          std::min(votes.least_m_per_rad, distance_m / std::max(sine, kAlongTheRay));
      AddRange(neighbour, normal, here, its_range_m, sigma_m, bearing, range_m, votes);
    } else if (behind_m > std::max(2.0F * tolerance_m, 0.03F * distance_m) && beside_px > 2.0F &&
               (neighbour.map->flags[at] & kDepthPriorOnly) == 0) {
      ++votes.seen_through;  // what only a plane of the surroundings says was not seen
    }
  }

  /// Range at which a ray of the neighbour cuts the plane of its pixel. `here`: normal . bearing of
  /// that pixel.
  static float SurfaceAlong(const Eigen::Vector3f& normal,
                            float here,
                            float its_range_m,
                            const Eigen::Vector3f& ray) {
    const float along = normal.dot(ray);
    const float ratio = here / along;
    return ratio > 0.8F && ratio < 1.25F ? its_range_m * ratio : its_range_m;
  }

  /// The range at which the own ray cuts the neighbour's plane.
  static void AddRange(const Neighbour& neighbour,
                       const Eigen::Vector3f& normal,
                       float here,
                       float its_range_m,
                       float sigma_m,
                       const Eigen::Vector3f& bearing,
                       float range_m,
                       Votes& votes) {
    const float offset_m = its_range_m * here;
    const float slope = normal.dot(neighbour.rotation * bearing);
    if (std::abs(slope) < 0.1F) return;
    const float cut_m = (offset_m - normal.dot(neighbour.translation)) / slope;
    if (std::abs(cut_m - range_m) > 0.03F * range_m) return;
    const float along = here / slope * sigma_m;
    votes.Add(cut_m - range_m, std::max(along * along, 1e-8F));
  }

  const DepthMap& own_;
  PixelBearings bearings_;
  PixelLookup lookup_;
  float pixel_rad_;
  std::vector<Neighbour> neighbours_{};
};

}  // namespace

DepthMap CheckDepths(DepthMap own,
                     const std::vector<NeighbourMap>& neighbours,
                     const DenseOptions& options) {
  if (own.face_px == 0) return own;
  const Checker checker(own, neighbours);
  for (size_t pixel = 0; pixel < own.size(); ++pixel) {  // each is asked of by itself alone
    if (!(own.range_m[pixel] > 0.0F)) continue;
    const Votes votes = checker.Ask(pixel);
    const int more = votes.sine < kLeastSine ? 1 : 0;
    const int needed =
        std::min(options.min_agreeing + more, static_cast<int>(checker.NumNeighbours()));
    const bool hollow = votes.seen_through >= std::max(1, votes.agreeing);
    const bool is_denied = votes.agreeing < options.min_agreeing_share * votes.asked;
    if (votes.agreeing < needed || hollow || is_denied) {
      own.range_m[pixel] = 0.0F;
      continue;
    }
    own.range_m[pixel] += votes.Mean();
    own.sigma_m[pixel] = votes.Sigma(kBias_px * checker.PixelAngle());
    own.views[pixel] = static_cast<uint8_t>(votes.agreeing);
    own.flags[pixel] |= kDepthChecked;
  }
  RemoveSpeckles(options.min_speckle_px, own);
  return own;
}

}  // namespace orbweave
