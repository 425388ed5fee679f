// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/move_images.h"

#include <algorithm>
#include <optional>

#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/model/triangulate_tracks.h"

namespace orbweave {
namespace {

constexpr double kSlack = 3.0;

/// How each registered image was moved along with the world around it, by slot.
using Displacements = std::map<ImageSlot, Rigid3>;

bool AreAlike(const Rigid3& x, const Rigid3& y) {
  constexpr double kRounding = 1e-9;
  return x.rotation.angularDistance(y.rotation) <= kRounding &&
         (x.translation - y.translation).norm() <= kRounding * (1.0 + x.translation.norm());
}

/// What all who see a point were moved by, if it was the same.
std::optional<Rigid3> CommonDisplacement(const MappingState& state,
                                         const MappedPoint& point,
                                         const Displacements& moved) {
  const auto of = [&](Node node) -> const Rigid3& {
    return moved.at(state.Graph().image_of_node[node]);
  };
  const Rigid3& first = of(point.nodes.front());
  const bool is_same =
      std::ranges::all_of(point.nodes, [&](Node node) { return AreAlike(of(node), first); });
  return is_same ? std::optional(first) : std::nullopt;
}

}  // namespace

void PutAt(MappingState& state, const CandidateMove& move) {
  for (const auto& [image, cam_from_world] : move) state.SetPose(image, cam_from_world);
}

CandidateMove PosesNow(const MappingState& state, const CandidateMove& of) {
  CandidateMove poses;
  for (const auto& [image, pose] : of) poses[image] = state.CamFromWorld(image);
  return poses;
}

CandidateMove Shifted(const MappingState& state,
                      const std::vector<ImageSlot>& images,
                      const Eigen::Vector3d& by) {
  CandidateMove move;
  for (const ImageSlot image : images) {
    move[image] = Rigid3::FromCentre(state.CamFromWorld(image).rotation, state.Centre(image) + by);
  }
  return move;
}

void RemakePoints(MappingState& moved, const MappingState& before, const MappingOptions& options) {
  Displacements displacements;
  for (const ImageSlot image : before.Registered())
    displacements[image] = moved.CamFromWorld(image).Inverse() * before.CamFromWorld(image);
  for (const PointIndex point : AllPoints(moved)) {
    const MappedPoint& mapped = moved.Point(point);
    if (const auto after_from_before = CommonDisplacement(moved, mapped, displacements)) {
      moved.SetPosition(point, *after_from_before * mapped.position);
    } else {
      moved.RemovePoint(point);
    }
  }
  TrackLimits limits = LimitsOf(options);
  limits.max_error_px *= kSlack;
  for (const auto& [image, after_from_before] : displacements)
    TriangulateImage(moved, image, limits);
}

}  // namespace orbweave
