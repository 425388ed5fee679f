// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/place_on_gnss.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/mapping/positioning/fit_plan.h"
#include "core/mapping/positioning/upright.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxImages = 30;
constexpr size_t kMinPositions = 4;
/// The scale is then good to a tenth with 25 positions, to a quarter with 4.
constexpr double kMinExtentSigmas = 2.0;

/// Cameras of the upright submodel and their positions.
struct Stations {
  std::vector<PlanStation> plan{};
  std::vector<double> centre_up{};
  std::vector<double> position_up{};
};

Stations StationsOf(const MappingState& state,
                    std::span<const ImageSlot> images,
                    const Eigen::Quaterniond& upright) {
  Stations stations;
  for (const ImageSlot image : images) {
    const PosePrior& prior = state.Problem().images[image].prior;
    if (!prior.position_in_enu) continue;
    const Vector3d centre = upright * state.Centre(image);
    stations.plan.push_back(SeenFromAbove(centre, prior));
    stations.centre_up.push_back(centre.z());
    stations.position_up.push_back(prior.position_in_enu->z());
  }
  return stations;
}

double MeanHeightOffset(const Stations& stations, double scale) {
  double sum = 0.0;
  double weights = 0.0;
  for (size_t i = 0; i < stations.plan.size(); ++i) {
    sum += stations.plan[i].weight * (stations.position_up[i] - scale * stations.centre_up[i]);
    weights += stations.plan[i].weight;
  }
  return sum / weights;
}

}  // namespace

std::vector<ImageSlot> ImagesNear(const MappingState& state, const Vector3d& place) {
  return ImagesNear(state, place, state.Registered());
}

std::vector<ImageSlot> ImagesNear(const MappingState& state,
                                  const Vector3d& place,
                                  std::vector<ImageSlot> images) {
  std::sort(images.begin(), images.end(), [&](ImageSlot x, ImageSlot y) {
    return std::tuple((state.Centre(x) - place).squaredNorm(), x) <
           std::tuple((state.Centre(y) - place).squaredNorm(), y);
  });
  images.resize(std::min(images.size(), kMaxImages));
  std::sort(images.begin(), images.end());
  return images;
}

std::optional<Sim3> PlaceOnGnss(const MappingState& state, std::span<const ImageSlot> images) {
  const std::optional<Eigen::Quaterniond> upright = UprightFromWorld(state, images);
  if (!upright) return std::nullopt;
  Stations stations = StationsOf(state, images, *upright);
  if (stations.plan.size() < kMinPositions) return std::nullopt;
  const PlanFit fit = FitPlanRobustly(stations.plan);
  const double scale = std::abs(fit.turn);
  if (!(scale > 0.0) || !(fit.extent_sigmas >= kMinExtentSigmas)) return std::nullopt;
  size_t agreeing = 0;
  for (const PlanStation& each : stations.plan)
    agreeing += fit.ErrorSigmas(each) <= kMaxFixSigmas ? 1U : 0U;
  if (static_cast<double>(agreeing) < kMinAgreeingFixes * static_cast<double>(stations.plan.size()))
    return std::nullopt;
  const Eigen::Quaterniond heading(Eigen::AngleAxisd(std::arg(fit.turn), Vector3d::UnitZ()));
  return Sim3{scale,
              (heading * *upright).normalized(),
              {fit.shift.real(), fit.shift.imag(), MeanHeightOffset(stations, scale)}};
}

}  // namespace orbweave
