// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/find_planes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

#include "core/base/random.h"
#include "core/dense/equiangular_raster.h"
#include "core/dense/plane_relief.h"
#include "core/geometry/cube_face.h"
#include "core/geometry/symmetric_eigen.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;
constexpr float kReliableCost = 0.35F;
constexpr float kReliableSigma = 0.03F;
constexpr size_t kSamples = 6000;
constexpr int kTrials = 200;
constexpr size_t kMaxPlanes = 24;
constexpr size_t kLeastInliers = 60;
constexpr float kLeastSigma_m = 0.002F;    // of a point, across its plane
constexpr double kLeastRelief_m = 0.0005;  // finer than patches, as the grain of asphalt
/// Of a point whose tolerance has more of its sigmas, one in a hundred leaves its plane by error;
/// means of others are drawn to the plane, as half of what is off it is cut away.
constexpr float kSigmasWithin = 2.5F;
constexpr int kPixelsOfAPatch = 121;    // which share errors
constexpr float kLeastCosine = 0.9F;    // between a pixel's normal and the plane's
constexpr float kSameCosine = 0.9976F;  // between planes that may be one: 4 degrees

float ToleranceAt(float range_m) { return 0.012F + 0.006F * range_m; }

float WeightOf(const ReliablePoint& p) {
  const float sigma_m = std::max(p.sigma_m, kLeastSigma_m);
  return 1.0F / (sigma_m * sigma_m);
}

size_t CountOn(std::span<const ReliablePoint> points, const FittedPlane& plane) {
  return static_cast<size_t>(
      std::ranges::count_if(points, [&](const ReliablePoint& p) { return LiesOn(p, plane); }));
}

/// Sums for a plane through points by least squares, each with the weight of its variance.
class PlaneSums {
 public:
  void Add(const ReliablePoint& p) {
    const Eigen::Vector3d x = p.point.cast<double>();
    const auto weight = static_cast<double>(WeightOf(p));
    weights_ += weight;
    sum_ += weight * x;
    squares_ += weight * x * x.transpose();
    ++count_;
  }

  void Add(const PlaneSums& other) {
    weights_ += other.weights_;
    sum_ += other.sum_;
    squares_ += other.squares_;
    count_ += other.count_;
  }

  [[nodiscard]] size_t Count() const { return count_; }
  [[nodiscard]] Eigen::Vector3f Mean() const { return (sum_ / weights_).cast<float>(); }

  /// The plane, with a normal on the side of `towards`.
  [[nodiscard]] FittedPlane Fit(const Eigen::Vector3f& towards) const {
    const Eigen::Vector3d mean = sum_ / weights_;
    const Eigen::Matrix3d spread = squares_ / weights_ - mean * mean.transpose();
    const SymmetricEigen<3> axes = EigenOf<3>(spread);
    Eigen::Vector3d normal = axes.vectors.col(0);
    if (normal.dot(towards.cast<double>()) < 0.0) normal = -normal;
    return {normal.cast<float>(),
            static_cast<float>(normal.dot(mean)),
            ErrorsOf(axes.values, axes.vectors, mean)};
  }

 private:
  /// All but relief. Points scatter as they do, whatever their sigmas say.
  [[nodiscard]] PlaneErrors ErrorsOf(const Eigen::Vector3d& variances,
                                     const Eigen::Matrix3d& axes,
                                     const Eigen::Vector3d& mean) const {
    const double independent =
        std::max(1.0, static_cast<double>(count_) / static_cast<double>(kPixelsOfAPatch));
    PlaneErrors errors;
    errors.fit_m = static_cast<float>(std::sqrt(std::max(variances[0], 0.0) / independent));
    errors.middle = mean.cast<float>();
    for (int k = 0; k < 2; ++k) {
      const double spread = std::sqrt(std::max(variances[k + 1], 1e-6));
      errors.axes.row(k) = (axes.col(k + 1) / spread).transpose().cast<float>();
    }
    return errors;
  }

  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
  double weights_ = 0.0;
  size_t count_ = 0;
};

/// Through the points on a plane.
FittedPlane Refit(std::span<const ReliablePoint> points, const FittedPlane& plane) {
  PlaneSums sums;
  for (const ReliablePoint& p : points) {
    if (LiesOn(p, plane)) sums.Add(p);
  }
  return sums.Fit(plane.normal);
}

/// The plane that most of the points lie on; a distance of 0 where they have none in common.
FittedPlane BestPlane(std::span<const ReliablePoint> points, Random& random) {
  FittedPlane best;
  size_t most = kLeastInliers;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ReliablePoint& p = points[random.Index(static_cast<uint32_t>(points.size()))];
    const FittedPlane plane{p.normal, p.normal.dot(p.point)};
    const size_t count = CountOn(points, plane);
    if (count <= most) continue;
    most = count;
    best = plane;
  }
  return best.distance_m > 0.0F ? Refit(points, Refit(points, best)) : best;
}

std::vector<ReliablePoint> Thinned(const std::vector<ReliablePoint>& points) {
  std::vector<ReliablePoint> some;
  const size_t step = std::max<size_t>(1, points.size() / kSamples);
  for (size_t k = 0; k < points.size(); k += step) some.push_back(points[k]);
  return some;
}

/// Each plane is looked for among what the ones before left, so that few points on a plain road
/// count beside the many on a wall.
std::vector<FittedPlane> FindLayers(std::vector<ReliablePoint> left, uint64_t seed) {
  Random random(seed);
  std::vector<FittedPlane> planes;
  while (planes.size() < kMaxPlanes && left.size() > kLeastInliers) {
    const FittedPlane plane = BestPlane(Thinned(left), random);
    if (!(plane.distance_m > 0.1F)) break;
    planes.push_back(plane);
    const size_t before = left.size();
    std::erase_if(left, [&](const ReliablePoint& p) { return LiesOn(p, plane); });
    if (left.size() == before) break;
  }
  return planes;
}

/// Whether a layer may be a part of a plane with more points: turned and moved no more than the
/// errors of its points explain.
bool IsLayerOf(const FittedPlane& layer, const PlaneSums& sums, const FittedPlane& plane) {
  const Eigen::Vector3f mean = sums.Mean();
  return layer.normal.dot(plane.normal) > kSameCosine &&
         std::abs(plane.normal.dot(mean) - plane.distance_m) < 2.0F * ToleranceAt(mean.norm());
}

/// Whether a plane is level and below the camera, or upright, within 12 degrees, as roads and walls
/// are. What lies otherwise is mostly cut out of the crown of a tree.
bool IsOfStreets(const FittedPlane& plane) {
  return plane.normal.y() > 0.978F || std::abs(plane.normal.y()) < 0.208F;
}

std::vector<PlaneSums> SumsOf(const std::vector<ReliablePoint>& points,
                              const std::vector<FittedPlane>& planes) {
  std::vector<PlaneSums> sums(planes.size());
  for (const ReliablePoint& p : points) {
    if (const size_t plane = NearestPlane(p, planes); plane < planes.size()) sums[plane].Add(p);
  }
  return sums;
}

/// The residuals of the points on each plane whose errors do not carry them off it.
std::vector<std::vector<PlaneResidual>> ResidualsOf(const std::vector<ReliablePoint>& points,
                                                    const std::vector<FittedPlane>& planes) {
  std::vector<std::vector<PlaneResidual>> residuals(planes.size());
  for (const ReliablePoint& p : points) {
    if (kSigmasWithin * p.sigma_m > ToleranceAt(p.point.norm())) continue;
    const size_t k = NearestPlane(p, planes);
    if (k == planes.size()) continue;
    const float off_m = planes[k].normal.dot(p.point) - planes[k].distance_m;
    residuals[k].push_back({p.pixel, off_m, WeightOf(p)});
  }
  return residuals;
}

/// Relief of the planes, and what it adds to the errors of their fits. Of a plane that tells
/// nothing no more is known than that its points lie within the tolerance.
void AddRelief(int face_px,
               const std::vector<ReliablePoint>& points,
               std::vector<FittedPlane>& planes) {
  const std::vector<std::vector<PlaneResidual>> residuals = ResidualsOf(points, planes);
  for (size_t k = 0; k < planes.size(); ++k) {
    PlaneErrors& errors = planes[k].errors;
    const std::optional<Relief> relief = ReliefOf(face_px, residuals[k]);
    if (!relief) {
      errors.relief_m = ToleranceAt(errors.middle.norm()) / std::numbers::sqrt3_v<float>;
      continue;
    }
    const double variance_m2 = relief->variance_m2;
    errors.relief_m = static_cast<float>(std::sqrt(kLeastRelief_m * kLeastRelief_m + variance_m2));
    errors.fit_m =
        std::hypot(errors.fit_m, static_cast<float>(std::sqrt(variance_m2 / relief->cells)));
  }
}

std::vector<FittedPlane> JoinLayers(const std::vector<ReliablePoint>& points,
                                    const std::vector<FittedPlane>& layers) {
  const std::vector<PlaneSums> sums = SumsOf(points, layers);
  std::vector<size_t> order(layers.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(
      order, std::ranges::greater{}, [&](size_t k) { return sums[k].Count(); });
  std::vector<FittedPlane> planes;
  std::vector<PlaneSums> joined;
  for (const size_t layer : order) {
    if (sums[layer].Count() < kLeastInliers || !IsOfStreets(layers[layer])) continue;
    size_t to = 0;
    while (to < planes.size() && !IsLayerOf(layers[layer], sums[layer], planes[to])) ++to;
    if (to == planes.size()) {
      planes.push_back(layers[layer]);
      joined.emplace_back();
    }
    joined[to].Add(sums[layer]);
  }
  for (size_t k = 0; k < planes.size(); ++k) planes[k] = joined[k].Fit(planes[k].normal);
  return planes;
}

}  // namespace

float TolerancesOff(const ReliablePoint& p, const FittedPlane& plane) {
  return std::abs(plane.normal.dot(p.point) - plane.distance_m) / ToleranceAt(p.point.norm());
}

bool LiesOn(const ReliablePoint& p, const FittedPlane& plane) {
  return TolerancesOff(p, plane) < 1.0F && p.normal.dot(plane.normal) > kLeastCosine;
}

std::vector<ReliablePoint> ReliablePoints(const ReferenceRaster& raster, const PlaneField& field) {
  std::vector<ReliablePoint> points;
  const EquiangularRaster pixels{raster.face_px};
  for (int face = 0; face < kCubeFaces; ++face) {
    const Eigen::Matrix3f camera_from_face = FaceFromCamera(face).transpose().cast<float>();
    for (int row = 0; row < raster.face_px; ++row) {
      for (int column = 0; column < raster.face_px; ++column) {
        const size_t at = field.AtPixel(face, row + kApron, column + kApron);
        if (!(field.cost[at] < kReliableCost) || !(field.sigma[at] < kReliableSigma)) continue;
        const Eigen::Vector3f q(field.x[at], field.y[at], field.z[at]);
        const Eigen::Vector3f ray(raster.tangents[static_cast<size_t>(column + kApron)],
                                  raster.tangents[static_cast<size_t>(row + kApron)],
                                  1.0F);
        points.push_back({camera_from_face * (ray / q.dot(ray)),
                          camera_from_face * q.normalized(),
                          static_cast<uint32_t>(pixels.Index(face, row, column)),
                          field.sigma[at] / q.norm()});
      }
    }
  }
  return points;
}

size_t NearestPlane(const ReliablePoint& point, const std::vector<FittedPlane>& planes) {
  size_t nearest = planes.size();
  float least = 1e9F;
  for (size_t k = 0; k < planes.size(); ++k) {
    const float off_m = std::abs(planes[k].normal.dot(point.point) - planes[k].distance_m);
    if (off_m >= least || !LiesOn(point, planes[k])) continue;
    least = off_m;
    nearest = k;
  }
  return nearest;
}

std::vector<FittedPlane> FindPlanes(int face_px,
                                    const std::vector<ReliablePoint>& points,
                                    uint64_t seed) {
  std::vector<FittedPlane> planes = JoinLayers(points, FindLayers(points, seed));
  AddRelief(face_px, points, planes);
  return planes;
}

}  // namespace orbweave
