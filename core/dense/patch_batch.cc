// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/patch_batch.h"

#include <algorithm>
#include <cmath>

#include "core/dense/depth_sigma.h"
#include "core/dense/free_slopes.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;
constexpr int kSamples = 3;
constexpr float kLeastFacing = 0.06F;  // cosine between normal and ray
constexpr float kSlopeSigma = 2.5F;    // of the tangent between normal and ray
/// Weights of a pixel's costs, ascending: a source that an occluder hides counts little.
constexpr std::array<float, kMaxViews> kCostWeights = {1.0F, 1.0F, 0.5F, 0.25F};

struct Offset {
  int row, column;
};

/// Pixels of the other colour, by region.
constexpr Offset kOffsets[kMatchRegions][kSamples] = {{{-1, 0}, {-2, -1}, {-2, 1}},
                                                      {{1, 0}, {2, -1}, {2, 1}},
                                                      {{0, -1}, {-1, -2}, {1, -2}},
                                                      {{0, 1}, {-1, 2}, {1, 2}},
                                                      {{-3, 0}, {-5, 0}, {-9, 0}},
                                                      {{3, 0}, {5, 0}, {9, 0}},
                                                      {{0, -3}, {0, -5}, {0, -9}},
                                                      {{0, 3}, {0, 5}, {0, 9}}};

}  // namespace

bool PatchBatch::Load(const MatchPlace& place,
                      int colour,
                      const ChosenViews& views,
                      bool also_empty) {
  place_ = place;
  colour_ = colour;
  views_ = &views;
  at_ = field_.At(place.face, colour, place.row, place.column >> 1);
  if (!IsOfUse(also_empty)) return false;
  const int left = (kApron + field_.FacePx() - place.column + 1) / 2;
  lanes_ = static_cast<size_t>(std::min(left, static_cast<int>(kMatchLanes)));
  PreparePatches(context_.scale, place, patches_);
  float level = 0.0F;
  for (size_t k = 0; k < kMatchLanes; ++k) {
    level += patches_.mean[k];
    ray_[k] = std::sqrt(patches_.x[k] * patches_.x[k] + patches_.y * patches_.y + 1.0F);
  }
  noise_variance_ = context_.noise.At(level / static_cast<float>(kMatchLanes));
  CopyHeld();
  if (round_.views_changed) Score(held_, held_cost_);
  baseline_ = Baseline();
  return true;
}

void PatchBatch::TryNeighbours() {
  FindRegions();
  for (int slot = 0; slot < round_.neighbours; ++slot) {
    for (size_t k = 0; k < lanes_; ++k) {
      const uint32_t from = regions_[static_cast<size_t>(slot)][k];
      Propose(k, {field_.x[from], field_.y[from], field_.z[from]});
    }
    Accept();
  }
}

void PatchBatch::TryRandom() {
  for (int slot = 0; slot < round_.fresh; ++slot) {
    for (size_t k = 0; k < lanes_; ++k) {
      PixelRandom random = RandomOf(k, 100 + slot);
      Propose(k, RandomPlane(patches_.x[k], patches_.y, context_.limits, random));
    }
    Accept();
  }
  for (int slot = 0; slot < round_.perturbed; ++slot) {
    for (size_t k = 0; k < lanes_; ++k) {
      PixelRandom random = RandomOf(k, slot);
      Propose(k, Perturbed(k, slot, random));
    }
    Accept();
  }
  if (round_.level) TryLevel();
}

void PatchBatch::TryLevel() {
  const Eigen::Vector3f down = FaceFromCamera(place_.face).col(1).cast<float>();
  bool any = false;
  for (size_t k = 0; k < lanes_; ++k) {
    const RayPlane held = Held(k);
    const float along = down.x() * patches_.x[k] + down.y() * patches_.y + down.z();
    const float factor = held.InverseDepth(patches_.x[k], patches_.y) / along;
    const bool slants = std::abs(along) > kLeastFacing * ray_[k];
    any |= slants;
    Propose(k, slants ? RayPlane{down.x() * factor, down.y() * factor, down.z() * factor} : held);
  }
  if (any) Accept();
}

void PatchBatch::Refine() {
  LaneFloats steps;
  for (size_t k = 0; k < kMatchLanes; ++k) steps[k] = RelativeStep(k, round_.refine_px);
  LaneFloats nearer;
  LaneFloats farther;
  Scale(steps, 1.0F);
  Score(tried_, nearer);
  Scale(steps, -1.0F);
  Score(tried_, farther);
  for (size_t k = 0; k < lanes_; ++k) {
    const CostMinimum minimum =
        FindMinimum(held_cost_[k], nearer[k], farther[k], steps[k], round_.refine_px);
    const float factor = 1.0F + minimum.offset;
    held_.x[k] *= factor;
    held_.y[k] *= factor;
    held_.z[k] *= factor;
    held_cost_[k] = minimum.cost;
    field_.sigma[at_ + k] = minimum.sigma;
  }
  if (round_.frees_slopes) FreeSlopes(steps);
}

void PatchBatch::FreeSlopes(const LaneFloats& steps) {
  const ReferenceRaster& raster = context_.scale.raster;
  const uint8_t* const middle =
      &raster.levels[static_cast<size_t>(place_.face)]
                    [static_cast<size_t>(place_.row * raster.Stride() + place_.column)];
  const TextureMoments moments =
      MomentsOfTexture(middle, raster.Stride(), patches_, Directions(), noise_variance_);
  const float pixel_rad = 1.5707963F / static_cast<float>(field_.FacePx());
  for (size_t k = 0; k < lanes_; ++k) {
    float& sigma = field_.sigma[at_ + k];
    if (!std::isfinite(sigma)) continue;
    const float parallax_px = round_.refine_px / steps[k];
    const float variance_px2 = sigma * sigma * parallax_px * parallax_px;
    const float slope = kSlopeSigma * pixel_rad * parallax_px;
    sigma = std::sqrt(FreeSlopeVariance(moments, k, variance_px2, slope)) / parallax_px;
  }
}

ParallaxDirections PatchBatch::Directions() const {
  const float x = patches_.x[kMatchLanes / 2];
  const float y = patches_.y;
  ParallaxDirections sums;
  float trace = 0.0F;
  for (int k = 0; k < views_->count; ++k) {
    const Eigen::Vector3f& centre =
        context_.scale
            .centres[views_->source[static_cast<size_t>(k)]][static_cast<size_t>(place_.face)];
    const float column = (centre.x() - x * centre.z()) / patches_.dx[kMatchLanes / 2];
    const float row = (centre.y() - y * centre.z()) / patches_.dy;
    sums.columns += column * column;
    sums.both += column * row;
    sums.rows += row * row;
    trace += column * column + row * row;
  }
  if (!(trace > 0.0F)) return {0.5F, 0.0F, 0.5F};
  return {sums.columns / trace, sums.both / trace, sums.rows / trace};
}

void PatchBatch::Store() {
  std::copy_n(held_.x.begin(), lanes_, &field_.x[at_]);
  std::copy_n(held_.y.begin(), lanes_, &field_.y[at_]);
  std::copy_n(held_.z.begin(), lanes_, &field_.z[at_]);
  std::copy_n(held_cost_.begin(), lanes_, &field_.cost[at_]);
}

bool PatchBatch::IsOfUse(bool also_empty) const {
  const int left = (kApron + field_.FacePx() - place_.column + 1) / 2;
  const auto count = static_cast<size_t>(std::min(left, static_cast<int>(kMatchLanes)));
  const auto& ignored = context_.scale.raster.ignored[static_cast<size_t>(place_.face)];
  const size_t pixel =
      static_cast<size_t>(place_.row * context_.scale.raster.Stride() + place_.column);
  for (size_t k = 0; k < count; ++k) {
    if (!ignored.empty() && ignored[pixel + 2 * k] != 0) continue;
    if (also_empty || field_.x[at_ + k] != 0.0F || field_.y[at_ + k] != 0.0F ||
        field_.z[at_ + k] != 0.0F)
      return true;
  }
  return false;
}

void PatchBatch::CopyHeld() {
  std::copy_n(&field_.x[at_], kMatchLanes, held_.x.begin());
  std::copy_n(&field_.y[at_], kMatchLanes, held_.y.begin());
  std::copy_n(&field_.z[at_], kMatchLanes, held_.z.begin());
  std::copy_n(&field_.cost[at_], kMatchLanes, held_cost_.begin());
}

PixelRandom PatchBatch::RandomOf(size_t lane, int slot) const {
  const auto column = static_cast<uint64_t>(place_.column) + 2 * lane;
  const uint64_t pixel = (static_cast<uint64_t>(place_.face) << 40) |
                         (static_cast<uint64_t>(place_.row) << 20) | column;
  const uint64_t draw =
      (static_cast<uint64_t>(round_.iteration) << 8) + static_cast<uint64_t>(slot);
  return PixelRandom(context_.seed, pixel, draw);
}

float PatchBatch::Baseline() const {
  const Eigen::Vector3f ray =
      Eigen::Vector3f(patches_.x[kMatchLanes / 2], patches_.y, 1.0F).normalized();
  float largest = 0.0F;
  float longest = 0.0F;
  for (int k = 0; k < views_->count; ++k) {
    const Eigen::Vector3f& centre =
        context_.scale
            .centres[views_->source[static_cast<size_t>(k)]][static_cast<size_t>(place_.face)];
    largest = std::max(largest, centre.cross(ray).norm());
    longest = std::max(longest, centre.norm());
  }
  return std::max(largest, 0.1F * longest);
}

float PatchBatch::RelativeStep(size_t k, float step_px) const {
  const float p0 = Held(k).InverseDepth(patches_.x[k], patches_.y);
  const float pixel_rad = 1.5707963F / static_cast<float>(field_.FacePx());
  return std::min(step_px * pixel_rad * ray_[k] / (baseline_ * p0), 0.3F);
}

void PatchBatch::Scale(const LaneFloats& steps, float sign) {
  for (size_t k = 0; k < kMatchLanes; ++k) {
    const float factor = 1.0F + sign * steps[k];
    tried_.x[k] = held_.x[k] * factor;
    tried_.y[k] = held_.y[k] * factor;
    tried_.z[k] = held_.z[k] * factor;
  }
}

RayPlane PatchBatch::Held(size_t k) const { return {held_.x[k], held_.y[k], held_.z[k]}; }

RayPlane PatchBatch::Perturbed(size_t k, int slot, PixelRandom& random) const {
  RayPlane q = Held(k);
  const float before = q.InverseDepth(patches_.x[k], patches_.y);
  if (slot % 3 != 2) {
    const float tilt = round_.tilt * std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
    q.x += tilt * random.Signed();
    q.y += tilt * random.Signed();
    q.z += tilt * random.Signed();
  }
  const float after = q.InverseDepth(patches_.x[k], patches_.y);
  float factor = before / after;
  if (slot % 3 != 0) factor *= 1.0F + RelativeStep(k, round_.step_px) * random.Signed();
  return {q.x * factor, q.y * factor, q.z * factor};
}

bool PatchBatch::IsInSight(size_t k, float p0, float size) const {
  return p0 * context_.limits.min_m < ray_[k] && p0 * context_.limits.max_m > ray_[k] &&
         p0 > kLeastFacing * size * ray_[k];
}

void PatchBatch::Propose(size_t k, const RayPlane& q) {
  const float p0 = q.InverseDepth(patches_.x[k], patches_.y);
  const float size = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  const bool fits = IsInSight(k, p0, size);
  tried_.x[k] = fits ? q.x : held_.x[k];
  tried_.y[k] = fits ? q.y : held_.y[k];
  tried_.z[k] = fits ? q.z : held_.z[k];
}

void PatchBatch::Match(const PlaneLanes& planes, size_t view, LaneFloats& costs) {
  const auto& of_face =
      context_.scale.views[views_->source[view]][static_cast<size_t>(place_.face)];
  context_.match(patches_, of_face, planes, noise_variance_, costs);
  for (float& cost : costs) cost = std::min(1.0F - cost, 1.0F);
}

void PatchBatch::SortPair(LaneFloats& a, LaneFloats& b) {
  for (size_t k = 0; k < kMatchLanes; ++k) {
    const float low = std::min(a[k], b[k]);
    b[k] = std::max(a[k], b[k]);
    a[k] = low;
  }
}

void PatchBatch::Score(const PlaneLanes& planes, LaneFloats& cost) {
  const auto count = static_cast<size_t>(views_->count);
  for (size_t view = 0; view < kMaxViews; ++view) {
    if (view < count) {
      Match(planes, view, costs_[view]);
    } else {
      costs_[view].fill(kNoPlaneCost);
    }
  }
  Combine(count, cost);
}

void PatchBatch::Combine(size_t count, LaneFloats& cost) {
  SortPair(costs_[0], costs_[1]);
  SortPair(costs_[2], costs_[3]);
  SortPair(costs_[0], costs_[2]);
  SortPair(costs_[1], costs_[3]);
  SortPair(costs_[1], costs_[2]);
  float weights = 0.0F;
  cost.fill(0.0F);
  for (size_t view = 0; view < count; ++view) {
    weights += kCostWeights[view];
    for (size_t k = 0; k < kMatchLanes; ++k) cost[k] += kCostWeights[view] * costs_[view][k];
  }
  for (float& sum : cost) sum /= weights;
}

bool PatchBatch::MayImprove() const {
  for (size_t k = 0; k < lanes_; ++k) {
    if (std::min(costs_[0][k], costs_[1][k]) < held_cost_[k] + 0.05F) return true;
  }
  return false;
}

void PatchBatch::Accept() {
  const auto count = static_cast<size_t>(views_->count);
  for (size_t view = 0; view < std::min<size_t>(count, 2); ++view)
    Match(tried_, view, costs_[view]);
  if (count > 2 && !MayImprove()) return;
  for (size_t view = 2; view < count; ++view) Match(tried_, view, costs_[view]);
  for (size_t view = count; view < kMaxViews; ++view) costs_[view].fill(kNoPlaneCost);
  LaneFloats cost;
  Combine(count, cost);
  for (size_t k = 0; k < lanes_; ++k) {
    if (!(cost[k] < held_cost_[k])) continue;
    Hold(k, cost[k]);
  }
}

void PatchBatch::Hold(size_t k, float cost) {
  held_cost_[k] = cost;
  held_.x[k] = tried_.x[k];
  held_.y[k] = tried_.y[k];
  held_.z[k] = tried_.z[k];
}

void PatchBatch::FindRegions() {
  std::array<LaneFloats, kMatchRegions> best;
  for (size_t region = 0; region < kMatchRegions; ++region) {
    best[region].fill(4.0F);
    for (const Offset& offset : kOffsets[region]) {
      const size_t first = field_.At(
          place_.face, 1 - colour_, place_.row + offset.row, (place_.column + offset.column) >> 1);
      const float* const costs = &field_.cost[first];
      for (size_t k = 0; k < kMatchLanes; ++k) {
        const bool better = costs[k] < best[region][k];
        best[region][k] = better ? costs[k] : best[region][k];
        regions_[region][k] = better ? static_cast<uint32_t>(first + k) : regions_[region][k];
      }
    }
  }
  // The cheapest rise to the front, all lanes side by side; of equal ones the first stays first.
  const auto slots = std::min(static_cast<size_t>(round_.neighbours), kMatchRegions - 1);
  for (size_t slot = 0; slot < slots; ++slot) {
    for (size_t to = kMatchRegions - 1; to > slot; --to) {
      for (size_t k = 0; k < kMatchLanes; ++k) {
        const bool rises = best[to][k] < best[to - 1][k];
        const float cost = rises ? best[to][k] : best[to - 1][k];
        const uint32_t from = rises ? regions_[to][k] : regions_[to - 1][k];
        best[to][k] = rises ? best[to - 1][k] : best[to][k];
        regions_[to][k] = rises ? regions_[to - 1][k] : regions_[to][k];
        best[to - 1][k] = cost;
        regions_[to - 1][k] = from;
      }
    }
  }
}

}  // namespace orbweave
