// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/turn_to_headings.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/graph/agreed_azimuth.h"
#include "core/graph/azimuth.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kAlike_rad = 20.0 * kDegree_rad;

}  // namespace

std::optional<double> TurnToHeadings(const Reconstruction& reconstruction,
                                     const Eigen::Quaterniond& upright_from_world,
                                     const ImageManifest& manifest) {
  std::vector<AzimuthVote> turns;  // the stated heading less what the model has
  for (const auto& [id, image] : reconstruction.images) {
    const std::optional<double>& heading_deg = manifest.At(id).prior.heading_deg;
    if (image.loose || !heading_deg) continue;
    const Vector3d forward =
        upright_from_world * (image.cam_from_world.rotation.conjugate() * Vector3d::UnitZ());
    turns.push_back(
        {.azimuth_rad = *heading_deg * kDegree_rad - std::atan2(forward.x(), forward.y())});
  }
  const std::optional<double> turn = AgreedAzimuth(std::move(turns), kAlike_rad);
  return turn ? std::optional(WrappedAzimuth(*turn)) : std::nullopt;
}

}  // namespace orbweave
