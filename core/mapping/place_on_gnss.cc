// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/place_on_gnss.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>
#include <vector>

#include "core/mapping/upright.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using Complex = std::complex<double>;

constexpr size_t kMaxImages = 30;
constexpr size_t kMinPositions = 4;
constexpr int kReweightings = 20;
constexpr double kMinAgreeing = 0.7;
constexpr double kMaxSigmas = 3.0;
/// The scale is then good to a tenth with 25 positions, to a quarter with 4.
constexpr double kMinExtentSigmas = 2.0;

/// A camera of the upright submodel and its position.
struct Station {
  Vector3d centre = Vector3d::Zero();
  Vector3d position = Vector3d::Zero();
  double sigma_m = 1.0;
  double weight = 1.0;

  [[nodiscard]] Complex Plan() const { return {centre.x(), centre.y()}; }
  [[nodiscard]] Complex PlanPosition() const { return {position.x(), position.y()}; }
};

std::optional<Eigen::Quaterniond> UprightFrom(const MappingState& state,
                                              std::span<const ImageSlot> images) {
  std::vector<Eigen::Quaterniond> cams_from_world;
  for (const ImageSlot image : images)
    cams_from_world.push_back(state.CamFromWorld(image).rotation);
  return UprightFromWorld(cams_from_world);
}

std::vector<Station> StationsOf(const MappingState& state,
                                std::span<const ImageSlot> images,
                                const Eigen::Quaterniond& upright) {
  std::vector<Station> stations;
  for (const ImageSlot image : images) {
    const PosePrior& prior = state.Problem().images[image].prior;
    if (!prior.position_in_enu) continue;
    stations.push_back({.centre = upright * state.Centre(image),
                        .position = *prior.position_in_enu,
                        .sigma_m = prior.horizontal_sigma_m});
  }
  return stations;
}

/// position = turn * plan + shift, with |turn| the scale.
struct PlanFit {
  Complex turn{};
  Complex shift{};
  double extent_sigmas = 0.0;  ///< rms distance of the centres from their mean
};

PlanFit FitPlan(const std::vector<Station>& stations) {
  double weights = 0.0;
  Complex from{};
  Complex to{};
  for (const Station& each : stations) {
    const double w = each.weight / (each.sigma_m * each.sigma_m);
    weights += w;
    from += w * each.Plan();
    to += w * each.PlanPosition();
  }
  from /= weights;
  to /= weights;
  Complex across{};
  double spread = 0.0;
  for (const Station& each : stations) {
    const double w = each.weight / (each.sigma_m * each.sigma_m);
    across += w * std::conj(each.Plan() - from) * (each.PlanPosition() - to);
    spread += w * std::norm(each.Plan() - from);
  }
  if (!(spread > 0.0)) return {};
  PlanFit fit{.turn = across / spread};
  fit.shift = to - fit.turn * from;
  fit.extent_sigmas = std::abs(fit.turn) * std::sqrt(spread / static_cast<double>(stations.size()));
  return fit;
}

double ErrorSigmas(const PlanFit& fit, const Station& station) {
  return std::abs(fit.turn * station.Plan() + fit.shift - station.PlanPosition()) / station.sigma_m;
}

/// Reweighted to the end.
PlanFit FitPlanRobustly(std::vector<Station>& stations) {
  const CauchyLoss loss(1.0);
  PlanFit fit = FitPlan(stations);
  for (int round = 0; round < kReweightings; ++round) {
    for (Station& each : stations) {
      const double error = ErrorSigmas(fit, each);
      each.weight = loss.Weight(error * error);
    }
    fit = FitPlan(stations);
  }
  return fit;
}

double MeanHeightOffset(const std::vector<Station>& stations, double scale) {
  double sum = 0.0;
  double weights = 0.0;
  for (const Station& each : stations) {
    sum += each.weight * (each.position.z() - scale * each.centre.z());
    weights += each.weight;
  }
  return sum / weights;
}

}  // namespace

std::vector<ImageSlot> ImagesNear(const MappingState& state, const Vector3d& place) {
  std::vector<ImageSlot> images = state.Registered();
  std::sort(images.begin(), images.end(), [&](ImageSlot x, ImageSlot y) {
    return std::tuple((state.Centre(x) - place).squaredNorm(), x) <
           std::tuple((state.Centre(y) - place).squaredNorm(), y);
  });
  images.resize(std::min(images.size(), kMaxImages));
  std::sort(images.begin(), images.end());
  return images;
}

std::optional<Sim3> PlaceOnGnss(const MappingState& state, std::span<const ImageSlot> images) {
  const std::optional<Eigen::Quaterniond> upright = UprightFrom(state, images);
  if (!upright) return std::nullopt;
  std::vector<Station> stations = StationsOf(state, images, *upright);
  if (stations.size() < kMinPositions) return std::nullopt;
  const PlanFit fit = FitPlanRobustly(stations);
  const double scale = std::abs(fit.turn);
  if (!(scale > 0.0) || !(fit.extent_sigmas >= kMinExtentSigmas)) return std::nullopt;
  size_t agreeing = 0;
  for (const Station& each : stations) agreeing += ErrorSigmas(fit, each) <= kMaxSigmas ? 1U : 0U;
  if (static_cast<double>(agreeing) < kMinAgreeing * static_cast<double>(stations.size()))
    return std::nullopt;
  const Eigen::Quaterniond heading(Eigen::AngleAxisd(std::arg(fit.turn), Vector3d::UnitZ()));
  return Sim3{scale,
              (heading * *upright).normalized(),
              {fit.shift.real(), fit.shift.imag(), MeanHeightOffset(stations, scale)}};
}

}  // namespace orbweave
