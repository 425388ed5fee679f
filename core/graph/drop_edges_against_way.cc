// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_way.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include "core/graph/find_headings.h"
#include "core/graph/in_sequence.h"
#include "core/graph/motion_edge.h"
#include "core/graph/turn_forest.h"
#include "core/scene/places_in_drives.h"

namespace orbweave {
namespace {

constexpr HeadingOptions kAhead = {.reach = 3, .agree_rad = std::numbers::pi / 4.0};
constexpr double kBack_rad = 2.0 * std::numbers::pi / 3.0;
constexpr double kOnward_rad = std::numbers::pi / 3.0;
constexpr size_t kFewestOnward = 2;
constexpr double kInOrder = 0.8;

/// Drives most of whose images have an edge with the next one, as far as that is in sequence.
std::set<uint32_t> DrivesInOrder(const std::vector<ViewEdge>& edges,
                                 const ImageManifest& manifest,
                                 const PlacesInDrives& places) {
  std::map<uint32_t, size_t> steps;
  for (const ImageRecord& image : manifest.images) {
    const std::optional<ImageId> next = places.After(image.id);
    if (next && IsInSequence(MakePair(image.id, *next), places)) ++steps[image.drive];
  }
  std::map<uint32_t, size_t> followed;
  for (const ViewEdge& edge : edges) {
    if (edge.kind == TwoViewKind::kNone || places.StepsBetween(edge.pair) != 1) continue;
    if (IsInSequence(edge.pair, places)) ++followed[manifest.At(edge.pair.a).drive];
  }
  std::set<uint32_t> in_order;
  for (const auto& [drive, count] : steps) {
    if (static_cast<double>(followed[drive]) >= kInOrder * static_cast<double>(count))
      in_order.insert(drive);
  }
  return in_order;
}

/// The steps of each image that lead onward: places of their other images in the drive.
using Onward = std::vector<std::vector<uint32_t>>;

Onward StepsOnward(const std::vector<MotionEdge>& steps,
                   const Headings& ahead,
                   const PlacesInDrives& places) {
  Onward onward(ahead.size());
  for (const MotionEdge& step : steps) {
    const std::optional<StepError> error = StepErrorOf(step, ahead);
    if (!error) continue;
    if (error->at_a_rad <= kOnward_rad) onward[step.a].push_back(places.PlaceOf(ImageId(step.b)));
    if (error->at_b_rad <= kOnward_rad) onward[step.b].push_back(places.PlaceOf(ImageId(step.a)));
  }
  return onward;
}

/// Whether the drive goes on at both images of a step as it comes to them, by others that lead from
/// before the two and beyond them: it does not where it turns round.
bool GoesOn(const MotionEdge& step, const Onward& onward, const PlacesInDrives& places) {
  const auto [first, last] =
      std::minmax({places.PlaceOf(ImageId(step.a)), places.PlaceOf(ImageId(step.b))});
  bool from_before = false;
  bool beyond = false;
  for (const uint32_t image : {step.a, step.b}) {
    if (onward[image].size() < kFewestOnward) return false;
    for (const uint32_t place : onward[image]) {
      from_before |= place < first;
      beyond |= place > last;
    }
  }
  return from_before && beyond;
}

/// Positions in `edges` of those that lead back.
std::set<uint32_t> FindThatLeadBack(const std::vector<ViewEdge>& edges,
                                    const ImageManifest& manifest) {
  const PlacesInDrives places(manifest);
  const std::set<uint32_t> in_order = DrivesInOrder(edges, manifest, places);
  const auto num_images = static_cast<uint32_t>(manifest.images.size());
  const TurnForest forest(num_images, MotionEdgesOf(edges, manifest, places));
  const std::vector<MotionEdge> steps = MotionEdgesAlongWay(edges, places);
  const Headings ahead = FindHeadings(steps, forest, std::vector<uint8_t>(num_images, 1), kAhead);
  const Onward onward = StepsOnward(steps, ahead, places);
  std::set<uint32_t> back;
  for (const MotionEdge& step : steps) {
    const std::optional<StepError> error = StepErrorOf(step, ahead);
    if (error && error->Least() > kBack_rad && GoesOn(step, onward, places) &&
        in_order.contains(manifest.images[step.a].drive))
      back.insert(step.edge);
  }
  return back;
}

}  // namespace

SiftedEdges DropEdgesAgainstWay(const std::vector<ViewEdge>& edges, const ImageManifest& manifest) {
  const std::set<uint32_t> back = FindThatLeadBack(edges, manifest);
  return SiftEdges(edges, DropCause::kSequence, [&](uint32_t e) -> std::string {
    return back.contains(e) ? "it leads back along the drive" : "";
  });
}

}  // namespace orbweave
