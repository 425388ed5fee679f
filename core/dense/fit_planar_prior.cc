// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/fit_planar_prior.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/dense/equiangular_raster.h"
#include "core/dense/find_planes.h"
#include "core/dense/plane_evidence.h"
#include "core/dense/rough_places.h"
#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

constexpr int kReach_px = 120;
constexpr uint8_t kSky = 254;             // a label until the others are given
constexpr float kLeastEvidence = 0.12F;   // correlation
constexpr float kEvidenceMargin = 0.03F;  // before the next plane

std::vector<uint8_t> LabelPoints(const std::vector<ReliablePoint>& points,
                                 const std::vector<FittedPlane>& planes,
                                 size_t num_pixels) {
  std::vector<uint8_t> labels(num_pixels, PlanarPrior::kNone);
  for (const ReliablePoint& p : points) {
    if (const size_t plane = NearestPlane(p, planes); plane < planes.size())
      labels[p.pixel] = static_cast<uint8_t>(plane);
  }
  return labels;
}

/// The planes that a ray may end on: nothing is seen through the ground.
class Sight {
 public:
  explicit Sight(const std::vector<FittedPlane>& planes) : planes_(planes) {}

  [[nodiscard]] bool IsLevel(size_t plane) const {
    return planes_[plane].normal.y() > kLevelCosine;
  }

  /// `bearing`: unit, in the camera frame.
  void Look(const Eigen::Vector3f& bearing) {
    bearing_ = bearing;
    ground_m_ = 0.0F;
    for (size_t k = 0; k < planes_.size(); ++k) {
      if (IsLevel(k)) ground_m_ = std::max(ground_m_, RangeOf(k));
    }
  }

  [[nodiscard]] bool MayBeSky() const { return ground_m_ == 0.0F; }

  /// No farther than the lowest of the level planes; streets have several, a kerb apart.
  [[nodiscard]] bool MayEndOn(size_t plane) const {
    return ground_m_ == 0.0F || RangeOf(plane) < kBeneath * ground_m_;
  }

 private:
  static constexpr float kLevelCosine = 0.9F;
  static constexpr float kBeneath = 1.03F;

  [[nodiscard]] float RangeOf(size_t plane) const {
    const float slant = planes_[plane].normal.dot(bearing_);
    return slant > 1e-3F ? planes_[plane].distance_m / slant : 0.0F;
  }

  const std::vector<FittedPlane>& planes_;
  Eigen::Vector3f bearing_ = Eigen::Vector3f::UnitZ();
  float ground_m_ = 0.0F;
};

/// What is seen around a cell speaks for one plane, and for no other one nearly as much; or for the
/// sky where that is not beneath the ground.
uint8_t SpokenFor(const PlaneEvidence& evidence,
                  const RoughPlaces& rough,
                  const Sight& sight,
                  size_t cell) {
  const size_t sky = evidence.correlation.size() - 1;
  uint8_t best = PlanarPrior::kNone;
  float most = kLeastEvidence;
  float second = 0.0F;
  for (size_t plane = 0; plane < sky; ++plane) {
    const float correlation = evidence.correlation[plane][cell];
    if (!sight.MayEndOn(plane)) continue;
    if (correlation > most) {
      second = best == PlanarPrior::kNone ? second : most;
      most = correlation;
      best = static_cast<uint8_t>(plane);
    } else {
      second = std::max(second, correlation);
    }
  }
  if (sight.MayBeSky() && evidence.correlation[sky][cell] > most - kEvidenceMargin) return kSky;
  if (best != PlanarPrior::kNone && rough[best][cell] != 0) return PlanarPrior::kNone;
  return most > second + kEvidenceMargin ? best : PlanarPrior::kNone;
}

/// Calls visit(pixel, cell, bearing) for the pixels of a raster.
template <typename Visitor>
void ForEachPixel(const EquiangularRaster& raster, Visitor&& visit) {
  const int cells = raster.face_px / 2;
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < raster.face_px; ++row) {
      for (int column = 0; column < raster.face_px; ++column) {
        const int cell = (face * cells + row / 2) * cells + column / 2;
        visit(raster.Index(face, row, column),
              static_cast<size_t>(cell),
              raster.BearingFromPixel(face, row + 0.5, column + 0.5).cast<float>());
      }
    }
  }
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
uint8_t Elect(const MetLabels& met, const Sight& sight) {
  const auto level = std::ranges::count_if(
      met.labels, [&](uint8_t label) { return label < kSky && sight.IsLevel(label); });
  uint8_t best = PlanarPrior::kNone;
  std::pair<int, int> best_rank;
  for (size_t k = 0; k < met.labels.size(); ++k) {
    const uint8_t label = met.labels[k];
    if (label >= kSky || !sight.MayEndOn(label)) continue;
    const auto count = static_cast<int>(std::ranges::count(met.labels, label));
    const bool may_be =
        sight.IsLevel(label) ? level >= 2 : count >= 2 && met.labels[kAbove] == label;
    const std::pair<int, int> rank(count, -met.distances_px[k]);
    if (!may_be || (best != PlanarPrior::kNone && rank <= best_rank)) continue;
    best = label;
    best_rank = rank;
  }
  return best;
}

}  // namespace

PlanarPrior LayOnPlanes(int face_px,
                        const std::vector<ReliablePoint>& points,
                        const std::vector<FittedPlane>& planes,
                        PlaneEvidence evidence) {
  const EquiangularRaster pixels{face_px};
  PlanarPrior prior{.face_px = face_px};
  for (const FittedPlane& plane : planes) {
    prior.planes.emplace_back(plane.InverseForm());
    prior.errors.push_back(plane.errors);
  }
  std::vector<uint8_t> labels = LabelPoints(points, planes, pixels.NumPixels());
  const RoughPlaces rough = FindRoughPlaces(face_px, points, planes);
  Sight sight(planes);
  ForEachPixel(pixels, [&](size_t pixel, size_t cell, const Eigen::Vector3f& bearing) {
    uint8_t& label = labels[pixel];
    if (label != PlanarPrior::kNone) {
      if (rough[label][cell] != 0) label = PlanarPrior::kNone;
      return;
    }
    sight.Look(bearing);
    label = SpokenFor(evidence, rough, sight, cell);
  });
  const LabelLooker looker(labels, pixels);
  prior.labels = labels;
  ForEachPixel(pixels, [&](size_t pixel, size_t cell, const Eigen::Vector3f& bearing) {
    if (labels[pixel] == kSky) prior.labels[pixel] = PlanarPrior::kNone;
    if (labels[pixel] != PlanarPrior::kNone) return;
    sight.Look(bearing);
    const uint8_t label = Elect(looker.Met(pixel), sight);
    if (label != PlanarPrior::kNone && rough[label][cell] == 0) prior.labels[pixel] = label;
  });
  prior.texture = std::move(evidence.texture);
  return prior;
}

PlanarPrior FitPlanarPrior(const PatchMatchContext& context, PlaneField& field) {
  const ReferenceRaster& raster = context.scale.raster;
  const std::vector<ReliablePoint> points = ReliablePoints(raster, field);
  const std::vector<FittedPlane> planes = FindPlanes(raster.face_px, points, context.seed);
  std::vector<Eigen::Vector3f> inverse_forms;
  for (const FittedPlane& plane : planes) inverse_forms.push_back(plane.InverseForm());
  return LayOnPlanes(raster.face_px, points, planes, GatherEvidence(context, inverse_forms, field));
}

}  // namespace orbweave
