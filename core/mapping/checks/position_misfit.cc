// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/position_misfit.h"

#include <algorithm>
#include <span>
#include <vector>

#include "core/mapping/checks/placed_images.h"
#include "core/mapping/positioning/position_agreement.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

constexpr size_t kPlacesAbout = 30;
constexpr GemanMcClureLoss kLoss(3.0);

/// Of one of `placed`, under the similarity that fits those around best.
double ErrorAmong(std::span<const PlacedImage> around, const PlacedImage& of) {
  std::vector<PlanStation> stations;
  for (const PlacedImage& one : around) stations.push_back(one.plan);
  return FitPlanRobustly(stations).ErrorSigmas(of.plan);
}

double Squared(double x) { return x * x; }

}  // namespace

PositionMisfit::PositionMisfit(const MappingState& state, double tolerance_px) {
  const RegisteredSequence places(state, tolerance_px);
  const std::vector<PlacedImage> placed = FindPlacedImages(state, places).images;
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
