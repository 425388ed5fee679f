// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/placed_images.h"

#include <optional>
#include <span>

#include "core/estimators/estimate_similarity.h"
#include "core/mapping/positioning/upright.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kFewestPositions = 10;

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

}  // namespace

PlacedImages FindPlacedImages(const MappingState& state, const RegisteredSequence& places) {
  std::vector<ImageSlot> images;
  for (size_t place = 0; place < places.size(); ++place) {
    if (state.Problem().images[places.At(place)].prior.position_in_enu)
      images.push_back(places.At(place));
  }
  if (images.size() < kFewestPositions) return {};
  const auto level_from_world = LevelFromWorld(state, images);
  if (!level_from_world) return {};
  PlacedImages placed{.level_from_world = *level_from_world};
  for (const ImageSlot image : images) {
    placed.images.push_back({image,
                             SeenFromAbove(*level_from_world * state.Centre(image),
                                           state.Problem().images[image].prior)});
  }
  return placed;
}

}  // namespace orbweave
