// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "core/dense/free_slopes.h"
#include "core/dense/patch_match_round.h"
#include "core/dense/planar_prior.h"
#include "core/dense/plane_field.h"
#include "core/dense/random_plane.h"

namespace orbweave {

/// Groups of pixels around one, from each of which the cheapest plane is tried.
inline constexpr size_t kMatchRegions = 8;

/// Cost of a pixel that has no plane.
inline constexpr float kNoPlaneCost = 2.0F;

/// The pixels of one colour in a row of a block, and what they hold.
class PatchBatch {
 public:
  PatchBatch(const PatchMatchContext& context, const PatchMatchRound& round, PlaneField& field)
      : context_(context), round_(round), field_(field) {}

  /// False where there is nothing to do: pixels that are ignored, or without a plane.
  bool Load(const MatchPlace& place, int colour, const ChosenViews& views, bool also_empty = false);

  void TryNeighbours();

  void TryRandom();

  /// To the minimum of the costs along the ray.
  void Refine();

  /// Leaves pixels of weak texture that may lie on a plane of the prior to it, without one of their
  /// own.
  void TryPrior(const PlanarPrior& prior);

  /// Of a plane q.x = 1 in the frame of the face, at all pixels; 1 where it cannot be.
  void ScorePlane(const Eigen::Vector3f& plane, LaneFloats& cost);

  /// Of what is infinitely far away.
  void ScoreSky(LaneFloats& cost);

  [[nodiscard]] size_t NumLanes() const { return lanes_; }

  /// Variance of a patch in variances of noise.
  [[nodiscard]] float TextureOf(size_t k) const {
    return patches_.scatter[k] / (noise_variance_ * patches_.weight_sum[k]);
  }

  /// Takes the planes of pixels that look no worse at infinity.
  void DropSky();

  void Store();

 private:
  [[nodiscard]] bool IsOfUse(bool also_empty) const;

  void CopyHeld();

  RayPlane Held(size_t k) const;

  PixelRandom RandomOf(size_t lane, int slot) const;

  /// Largest distance of a chosen source from the line of sight.
  float Baseline() const;

  /// Roads lie flatter to the ray than random planes do. y of the camera frame points down.
  void TryLevel();

  /// What the sigmas are when slopes are not known; `steps`: of the inverse range, as shares, that
  /// make round_.refine_px of parallax.
  void FreeSlopes(const LaneFloats& steps);

  /// In which the chosen sources see pixels move.
  [[nodiscard]] ParallaxDirections Directions() const;

  /// The share of the inverse range that makes `step_px` of parallax.
  float RelativeStep(size_t k, float step_px) const;

  void Scale(const LaneFloats& steps, float sign);

  RayPlane Perturbed(size_t k, int slot, PixelRandom& random) const;

  /// Whether a plane |q| = `size` of inverse depth p0 is in range and not seen from its edge.
  [[nodiscard]] bool IsInSight(size_t k, float p0, float size) const;

  /// A plane to try, unless it is out of range or seen from its edge.
  void Propose(size_t k, const RayPlane& q);

  void Match(const PlaneLanes& planes, size_t view, LaneFloats& costs);

  static void SortPair(LaneFloats& a, LaneFloats& b);

  void Score(const PlaneLanes& planes, LaneFloats& cost);

  void Combine(size_t count, LaneFloats& cost);

  /// Whether one of the first two sources likes a plane nearly as much as the held one.
  bool MayImprove() const;

  void Accept();

  void Hold(size_t k, float cost);

  void Drop(size_t k);

  /// Of the raster, without aprons.
  [[nodiscard]] size_t PixelOf(size_t k) const;

  /// The cheapest pixel of each region around each lane, the first round_.neighbours in order of
  /// cost.
  void FindRegions();

  const PatchMatchContext& context_;
  const PatchMatchRound& round_;
  PlaneField& field_;
  float noise_variance_ = 0.0F;
  MatchPlace place_{};
  int colour_ = 0;
  const ChosenViews* views_ = nullptr;
  size_t at_ = 0;
  size_t lanes_ = 0;
  float baseline_ = 1.0F;
  ReferencePatches patches_{};
  LaneFloats ray_{};
  PlaneLanes held_{};
  PlaneLanes tried_{};
  LaneFloats held_cost_{};
  std::array<LaneFloats, kMaxViews> costs_{};
  std::array<std::array<uint32_t, kMatchLanes>, kMatchRegions> regions_{};  ///< places in field_
};

}  // namespace orbweave
