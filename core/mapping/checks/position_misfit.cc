// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/position_misfit.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "core/estimators/estimate_similarity.h"
#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/positioning/fit_plan.h"
#include "core/mapping/positioning/position_agreement.h"
#include "core/mapping/positioning/upright.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kFewestPositions = 10;
constexpr size_t kPlacesAbout = 30;
constexpr GemanMcClureLoss kLoss(3.0);

/// An image with a position.
struct Placed {
  ImageSlot image = 0;
  PlanStation plan{};
};

std::optional<Eigen::Quaterniond> LevelFromWorld(const MappingState& state,
                                                 std::span<const ImageSlot> images) {
  if (const auto upright = UprightFromWorld(state, images)) return upright;
  std::vector<Vector3d> centres;
  std::vector<Vector3d> positions;
  for (const ImageSlot image : images) {
    centres.push_back(state.Centre(image));
    positions.push_back(*state.Problem().images[image].prior.position_in_enu);
  }
  const std::optional<Sim3> enu_from_world = FitSimilarity(centres, positions, {});
  if (!enu_from_world) return std::nullopt;
  return enu_from_world->rotation;
}

/// In the order of places.
std::vector<Placed> PlacedImages(const MappingState& state, double tolerance_px) {
  const RegisteredSequence places(state, tolerance_px);
  std::vector<ImageSlot> images;
  for (size_t place = 0; place < places.size(); ++place) {
    if (state.Problem().images[places.At(place)].prior.position_in_enu)
      images.push_back(places.At(place));
  }
  if (images.size() < kFewestPositions) return {};
  const auto level_from_world = LevelFromWorld(state, images);
  if (!level_from_world) return {};
  std::vector<Placed> placed;
  for (const ImageSlot image : images) {
    placed.push_back({image,
                      SeenFromAbove(*level_from_world * state.Centre(image),
                                    state.Problem().images[image].prior)});
  }
  return placed;
}

/// Of one of `placed`, under the similarity that fits those around best.
double ErrorAmong(std::span<const Placed> around, const Placed& of) {
  std::vector<PlanStation> stations;
  for (const Placed& one : around) stations.push_back(one.plan);
  return FitPlanRobustly(stations).ErrorSigmas(of.plan);
}

double Squared(double x) { return x * x; }

}  // namespace

PositionMisfit::PositionMisfit(const MappingState& state, double tolerance_px) {
  const std::vector<Placed> placed = PlacedImages(state, tolerance_px);
  std::vector<double> errors;
  for (size_t i = 0; i < placed.size(); ++i) {
    const size_t first = i - std::min(i, kPlacesAbout);
    const size_t end = std::min(placed.size(), i + kPlacesAbout + 1);
    errors.push_back(ErrorAmong(std::span(placed).subspan(first, end - first), placed[i]));
    errors_[placed[i].image] = errors.back();
  }
  if (!errors.empty()) scatter_ = ScatterOfPositions(errors);
}

double PositionMisfit::Beside(const PositionMisfit& other) const {
  const double scatter = std::min(scatter_, other.scatter_);
  double sum = 0.0;
  for (const auto& [image, error] : errors_) {
    if (other.errors_.contains(image)) sum += kLoss.Cost(Squared(error / scatter));
  }
  return sum;
}

double PositionMisfit::MeanBeside(const PositionMisfit& other) const {
  const double scatter = std::min(scatter_, other.scatter_);
  double sum = 0.0;
  for (const auto& [image, error] : errors_) sum += kLoss.Cost(Squared(error / scatter));
  return errors_.empty() ? 0.0 : sum / static_cast<double>(errors_.size());
}

}  // namespace orbweave
