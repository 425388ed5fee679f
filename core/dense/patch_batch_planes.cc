// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The trials of PatchBatch that look beyond the pixels around: planes of the surroundings, the sky.

#include <algorithm>
#include <limits>

#include "core/dense/equiangular_raster.h"
#include "core/dense/patch_batch.h"

namespace orbweave {
namespace {

constexpr float kSkyMargin = 0.02F;
constexpr float kPriorMargin = 0.4F;
constexpr float kHalfTexture = 4.0F;  // counts as half textured
constexpr float kInfinity_m = 1e5F;

}  // namespace

void PatchBatch::TryPrior(const PlanarPrior& prior) {
  const Eigen::Matrix3f face_from_camera = FaceFromCamera(place_.face).cast<float>();
  std::array<bool, kMatchLanes> has_plane{};
  for (size_t k = 0; k < lanes_; ++k) {
    const uint8_t label = prior.labels[PixelOf(k)];
    has_plane[k] = label != PlanarPrior::kNone;
    if (!has_plane[k]) {
      Propose(k, Held(k));
      continue;
    }
    const Eigen::Vector3f q = face_from_camera * prior.planes[label];
    Propose(k, {q.x(), q.y(), q.z()});
  }
  if (std::ranges::none_of(has_plane, [](bool has) { return has; })) return;
  LaneFloats cost;
  Score(tried_, cost);
  for (size_t k = 0; k < lanes_; ++k) {
    if (!has_plane[k]) continue;
    const float texture = TextureOf(k);
    const float fade = kHalfTexture / (kHalfTexture + texture);
    if (!(cost[k] < std::min(held_cost_[k], 1.0F) + kPriorMargin * fade)) continue;
    if (texture < kWeakTexture) {
      Drop(k);
    } else {
      Hold(k, cost[k]);
    }
  }
}

void PatchBatch::ScorePlane(const Eigen::Vector3f& plane, LaneFloats& cost) {
  const float size = plane.norm();
  const auto inverse_depth = [&](size_t k) {
    return plane.x() * patches_.x[k] + plane.y() * patches_.y + plane.z();
  };
  bool any = false;
  for (size_t k = 0; k < kMatchLanes; ++k) any |= IsInSight(k, inverse_depth(k), size);
  cost.fill(1.0F);
  if (!any) return;
  tried_.x.fill(plane.x());
  tried_.y.fill(plane.y());
  tried_.z.fill(plane.z());
  Score(tried_, cost);
  for (size_t k = 0; k < kMatchLanes; ++k) {
    if (!IsInSight(k, inverse_depth(k), size)) cost[k] = 1.0F;
  }
}

void PatchBatch::ScoreSky(LaneFloats& cost) {
  for (size_t k = 0; k < kMatchLanes; ++k) {
    const float inverse = 1.0F / (kInfinity_m * ray_[k]);
    tried_.x[k] = patches_.x[k] * inverse;
    tried_.y[k] = patches_.y * inverse;
    tried_.z[k] = inverse;
  }
  Score(tried_, cost);
}

void PatchBatch::DropSky() {
  LaneFloats cost;
  ScoreSky(cost);
  for (size_t k = 0; k < lanes_; ++k) {
    if (cost[k] < held_cost_[k] + kSkyMargin) Drop(k);
  }
}

void PatchBatch::Drop(size_t k) {
  held_.x[k] = held_.y[k] = held_.z[k] = 0.0F;
  held_cost_[k] = kNoPlaneCost;
  field_.sigma[at_ + k] = std::numeric_limits<float>::infinity();
}

size_t PatchBatch::PixelOf(size_t k) const {
  constexpr int kApron = PlaneField::kApron_px;
  const int column = place_.column - kApron + 2 * static_cast<int>(k);
  return EquiangularRaster{field_.FacePx()}.Index(place_.face, place_.row - kApron, column);
}

}  // namespace orbweave
