// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/planar_prior.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/base/random.h"
#include "core/dense/equiangular_raster.h"
#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;
constexpr float kReliableCost = 0.35F;
constexpr float kReliableSigma = 0.03F;
constexpr size_t kSamples = 6000;
constexpr int kTrials = 200;
constexpr size_t kMaxPlanes = 24;
constexpr size_t kLeastInliers = 60;
constexpr float kLeastCosine = 0.9F;  // between a pixel's normal and the plane's
constexpr int kReach_px = 120;

/// A pixel that matches well, in the camera frame.
struct ReliablePoint {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;
  uint32_t pixel;
};

/// n.x = d with unit n.
struct FittedPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float distance_m = 0.0F;
};

float ToleranceAt(float range_m) { return 0.012F + 0.004F * range_m; }

bool LiesOn(const ReliablePoint& p, const FittedPlane& plane) {
  return std::abs(plane.normal.dot(p.point) - plane.distance_m) < ToleranceAt(p.point.norm()) &&
         p.normal.dot(plane.normal) > kLeastCosine;
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
                          static_cast<uint32_t>(pixels.Index(face, row, column))});
      }
    }
  }
  return points;
}

size_t CountOn(std::span<const ReliablePoint> points, const FittedPlane& plane) {
  return static_cast<size_t>(
      std::ranges::count_if(points, [&](const ReliablePoint& p) { return LiesOn(p, plane); }));
}

/// Least squares through the points on a plane, those far away counting less.
FittedPlane Refit(std::span<const ReliablePoint> points, const FittedPlane& plane) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double weights = 0.0;
  for (const ReliablePoint& p : points) {
    if (!LiesOn(p, plane)) continue;
    const Eigen::Vector3d x = p.point.cast<double>();
    const double tolerance_m = ToleranceAt(p.point.norm());
    const double weight = 1.0 / (tolerance_m * tolerance_m);
    weights += weight;
    sum += weight * x;
    squares += weight * x * x.transpose();
  }
  const Eigen::Vector3d mean = sum / weights;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / weights -
                                                              mean * mean.transpose());
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (normal.dot(plane.normal.cast<double>()) < 0.0) normal = -normal;
  return {normal.cast<float>(), static_cast<float>(normal.dot(mean))};
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
std::vector<FittedPlane> FindPlanes(std::vector<ReliablePoint> left, uint64_t seed) {
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

/// The plane of each pixel that matches well and lies on one.
std::vector<uint8_t> LabelPoints(const std::vector<ReliablePoint>& points,
                                 const std::vector<FittedPlane>& planes,
                                 size_t num_pixels,
                                 PlanarPrior& prior) {
  std::vector<uint8_t> labels(num_pixels, PlanarPrior::kNone);
  std::vector<double> squares(planes.size());
  std::vector<double> counts(planes.size(), 1.0);
  for (const ReliablePoint& p : points) {
    float least = 1e9F;
    for (size_t k = 0; k < planes.size(); ++k) {
      const float off_m = std::abs(planes[k].normal.dot(p.point) - planes[k].distance_m);
      if (off_m >= least || !LiesOn(p, planes[k])) continue;
      least = off_m;
      labels[p.pixel] = static_cast<uint8_t>(k);
    }
    if (labels[p.pixel] == PlanarPrior::kNone) continue;
    squares[labels[p.pixel]] += static_cast<double>(least) * least;
    counts[labels[p.pixel]] += 1.0;
  }
  for (size_t k = 0; k < planes.size(); ++k) {
    prior.planes.emplace_back(planes[k].normal / planes[k].distance_m);
    prior.scatter_m.push_back(static_cast<float>(std::sqrt(squares[k] / counts[k])));
  }
  return labels;
}

/// Labels met first to the left, to the right, above and below, and how far away.
struct MetLabels {
  std::array<uint8_t, 4> labels{};
  std::array<uint8_t, 4> distances_px{};
};
constexpr size_t kAbove = 2;

class LabelLooker {
 public:
  LabelLooker(const std::vector<uint8_t>& labels, const EquiangularRaster& raster)
      : labels_(labels), raster_(raster), met_(raster.NumPixels()) {
    for (MetLabels& met : met_) met.labels.fill(PlanarPrior::kNone);
    const int size = raster.face_px;
    for (int face = 0; face < kCubeFaces; ++face) {
      for (int line = 0; line < size; ++line) {
        Walk(0, size, [&](int k) { return raster_.Index(face, line, k); });
        Walk(1, size, [&](int k) { return raster_.Index(face, line, size - 1 - k); });
        Walk(2, size, [&](int k) { return raster_.Index(face, k, line); });
        Walk(3, size, [&](int k) { return raster_.Index(face, size - 1 - k, line); });
      }
    }
  }

  [[nodiscard]] const MetLabels& Met(size_t pixel) const { return met_[pixel]; }

 private:
  template <typename PixelOf>
  void Walk(size_t direction, int size, PixelOf&& pixel_of) {
    uint8_t last = PlanarPrior::kNone;
    int since = 0;
    for (int k = 0; k < size; ++k, ++since) {
      const size_t pixel = pixel_of(k);
      if (labels_[pixel] != PlanarPrior::kNone) {
        last = labels_[pixel];
        since = 0;
      }
      if (since >= kReach_px) continue;
      met_[pixel].labels[direction] = last;
      met_[pixel].distances_px[direction] = static_cast<uint8_t>(since);
    }
  }

  const std::vector<uint8_t>& labels_;
  EquiangularRaster raster_;
  std::vector<MetLabels> met_;
};

/// The plane met in most directions, of several the one met nearest. Level planes, of which streets
/// have several a kerb apart, need a second one of any height; others must be met twice, once
/// above.
uint8_t Elect(const MetLabels& met, const std::vector<uint8_t>& is_level) {
  const auto level = std::ranges::count_if(met.labels, [&](uint8_t label) {
    return label != PlanarPrior::kNone && is_level[label] != 0;
  });
  uint8_t best = PlanarPrior::kNone;
  std::pair<int, int> best_rank;
  for (size_t k = 0; k < met.labels.size(); ++k) {
    const uint8_t label = met.labels[k];
    if (label == PlanarPrior::kNone) continue;
    const auto count = static_cast<int>(std::ranges::count(met.labels, label));
    const bool may_be =
        is_level[label] != 0 ? level >= 2 : count >= 2 && met.labels[kAbove] == label;
    const std::pair<int, int> rank(count, -met.distances_px[k]);
    if (!may_be || (best != PlanarPrior::kNone && rank <= best_rank)) continue;
    best = label;
    best_rank = rank;
  }
  return best;
}

}  // namespace

PlanarPrior FitPlanarPrior(const ReferenceRaster& raster, const PlaneField& field, uint64_t seed) {
  const EquiangularRaster pixels{raster.face_px};
  PlanarPrior prior{.face_px = raster.face_px};
  const std::vector<ReliablePoint> points = ReliablePoints(raster, field);
  const std::vector<FittedPlane> planes = FindPlanes(points, seed);
  const std::vector<uint8_t> labels = LabelPoints(points, planes, pixels.NumPixels(), prior);
  std::vector<uint8_t> is_level;
  for (const FittedPlane& plane : planes) is_level.push_back(plane.normal.y() > 0.9F ? 1 : 0);
  const LabelLooker looker(labels, pixels);
  prior.labels.resize(pixels.NumPixels());
  for (size_t k = 0; k < prior.labels.size(); ++k) {
    prior.labels[k] = labels[k] != PlanarPrior::kNone ? labels[k] : Elect(looker.Met(k), is_level);
  }
  return prior;
}

}  // namespace orbweave
