// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/turn_to_headings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "core/graph/azimuth.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kAlike_rad = 20.0 * kDegree_rad;
constexpr size_t kFewest = 3;

/// Of each panorama that states its heading, that less what the model has.
std::vector<double> TurnsOf(const Reconstruction& reconstruction,
                            const Eigen::Quaterniond& upright_from_world,
                            const ImageManifest& manifest) {
  std::vector<double> turns;
  for (const auto& [id, image] : reconstruction.images) {
    const std::optional<double>& heading_deg = manifest.At(id).prior.heading_deg;
    if (image.loose || !heading_deg) continue;
    const Vector3d forward =
        upright_from_world * (image.cam_from_world.rotation.conjugate() * Vector3d::UnitZ());
    turns.push_back(
        WrappedAzimuth(*heading_deg * kDegree_rad - std::atan2(forward.x(), forward.y())));
  }
  return turns;
}

std::vector<double> AlikeTo(double turn, const std::vector<double>& turns) {
  std::vector<double> alike;
  std::ranges::copy_if(turns, std::back_inserter(alike), [&](double each) {
    return AngleBetweenAzimuths(each, turn) <= kAlike_rad;
  });
  return alike;
}

double MeanOf(double turn, const std::vector<double>& alike) {
  double sum = 0.0;
  for (const double each : alike) sum += WrappedAzimuth(each - turn);
  return WrappedAzimuth(turn + sum / static_cast<double>(alike.size()));
}

}  // namespace

std::optional<double> TurnToHeadings(const Reconstruction& reconstruction,
                                     const Eigen::Quaterniond& upright_from_world,
                                     const ImageManifest& manifest) {
  const std::vector<double> turns = TurnsOf(reconstruction, upright_from_world, manifest);
  std::vector<double> most;
  double turn = 0.0;
  for (const double each : turns) {
    std::vector<double> alike = AlikeTo(each, turns);
    if (alike.size() <= most.size()) continue;
    most = std::move(alike);
    turn = each;
  }
  if (most.size() < kFewest || 2 * most.size() <= turns.size()) return std::nullopt;
  return MeanOf(turn, most);
}

}  // namespace orbweave
