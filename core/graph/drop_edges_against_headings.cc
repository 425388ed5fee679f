// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_headings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "core/graph/find_headings.h"
#include "core/graph/motion_edge.h"
#include "core/graph/trusted_positions.h"
#include "core/graph/turn_forest.h"
#include "core/scene/places_in_drives.h"

namespace orbweave {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kAlikeErrors_m = 15.0;
constexpr double kOtherWay_rad = std::numbers::pi / 2.0;

/// What may speak against an edge.
struct Compass {
  Headings headings{};
  std::vector<uint8_t> is_trusted{};  ///< per image: its position
  std::vector<uint8_t> is_settled{};  ///< per image: its heading
};

/// Per image: whether most of its edges, by weight, turn as the headings do: those of its
/// neighbours in the sequence, where it has any.
std::vector<uint8_t> SettledHeadings(const std::vector<MotionEdge>& edges,
                                     const Headings& headings) {
  struct Tally {
    double all = 0.0;
    double otherwise = 0.0;
  };
  std::vector<Tally> of_all(headings.size());
  std::vector<Tally> of_sequence(headings.size());
  for (const MotionEdge& edge : edges) {
    if (!TurnErrorOf(edge, headings)) continue;
    const double otherwise = TurnsOtherwise(edge, headings) ? edge.weight : 0.0;
    for (const uint32_t image : {edge.a, edge.b}) {
      of_all[image].all += edge.weight;
      of_all[image].otherwise += otherwise;
      if (!edge.is_in_sequence) continue;
      of_sequence[image].all += edge.weight;
      of_sequence[image].otherwise += otherwise;
    }
  }
  std::vector<uint8_t> is_settled(headings.size(), 0);
  for (size_t image = 0; image < headings.size(); ++image) {
    const Tally& tally = of_sequence[image].all > 0.0 ? of_sequence[image] : of_all[image];
    is_settled[image] = headings[image] && 2.0 * tally.otherwise <= tally.all;
  }
  return is_settled;
}

Compass CompassOf(const std::vector<MotionEdge>& edges,
                  const ImageManifest& manifest,
                  const PlacesInDrives& places) {
  const auto num_images = static_cast<uint32_t>(manifest.images.size());
  const TurnForest forest(num_images, edges);
  Compass compass{.is_trusted = std::vector<uint8_t>(num_images, 1)};
  for (int round = 0; round < 2; ++round) {
    compass.headings = FindHeadings(edges, forest, compass.is_trusted);
    compass.is_trusted = TrustedPositions(edges, compass.headings, manifest, places);
  }
  compass.is_settled = SettledHeadings(edges, compass.headings);
  return compass;
}

bool LeadsElsewhere(const MotionEdge& edge, const StepError& error) {
  return error.miss_m > std::max(kSigmas * edge.step->sigma_m, kAlikeErrors_m) ||
         (error.Least() > kOtherWay_rad && edge.step->IsTelling());
}

/// Why the edge is not believed; empty where it is.
std::string FaultOf(const MotionEdge& edge, const Compass& compass) {
  const auto both = [&](const std::vector<uint8_t>& are) {
    return are[edge.a] != 0 && are[edge.b] != 0;
  };
  if (both(compass.is_settled) && TurnsOtherwise(edge, compass.headings)) {
    const double error_rad = *TurnErrorOf(edge, compass.headings);
    return "it turns by " + std::to_string(std::lround(error_rad * 180.0 / std::numbers::pi)) +
           " degrees otherwise than cameras are headed by GNSS";
  }
  const std::optional<StepError> error = StepErrorOf(edge, compass.headings);
  if (!error || !both(compass.is_trusted) || !LeadsElsewhere(edge, *error)) return "";
  if (error->Least() > kOtherWay_rad) return "it leads the other way than GNSS";
  return "it misses the GNSS positions by " + std::to_string(std::lround(error->miss_m)) + " m";
}

}  // namespace

SiftedEdges DropEdgesAgainstHeadings(const std::vector<ViewEdge>& edges,
                                     const ImageManifest& manifest) {
  const PlacesInDrives places(manifest);
  const std::vector<MotionEdge> motions = MotionEdgesOf(edges, manifest, places);
  const Compass compass = CompassOf(motions, manifest, places);
  std::vector<std::string> faults(edges.size());
  for (const MotionEdge& motion : motions) faults[motion.edge] = FaultOf(motion, compass);
  return SiftEdges(
      edges, DropCause::kGnss, [&](uint32_t e) -> std::string { return std::move(faults[e]); });
}

}  // namespace orbweave
