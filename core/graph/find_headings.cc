// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/find_headings.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/graph/agreed_azimuth.h"

namespace orbweave {
namespace {

// Of cameras that stand upright to some degrees.
constexpr double kTilt_rad = 5.0 * std::numbers::pi / 180.0;

/// Of camera a.
std::optional<AzimuthVote> VoteOf(const MotionEdge& edge) {
  if (!edge.step || !edge.step->IsTelling()) return std::nullopt;
  const double sigma_rad = std::hypot(edge.step->sigma_m / edge.step->distance_m, kTilt_rad);
  return AzimuthVote{edge.step->HeadingOfA(), sigma_rad, edge.weight / sigma_rad};
}

}  // namespace

Headings FindHeadings(const std::vector<MotionEdge>& edges,
                      const TurnForest& forest,
                      const std::vector<uint8_t>& is_trusted,
                      const HeadingOptions& options) {
  const size_t num_images = is_trusted.size();
  std::vector<std::vector<uint32_t>> edges_from(num_images);
  for (uint32_t e = 0; e < edges.size(); ++e) {
    if (is_trusted[edges[e].a] != 0 && is_trusted[edges[e].b] != 0)
      edges_from[edges[e].a].push_back(e);
  }
  Headings headings(num_images);
  for (uint32_t image = 0; image < num_images; ++image) {
    std::vector<AzimuthVote> in_sequence;
    std::vector<AzimuthVote> all;
    for (const TurnForest::Link& near : forest.Around(image, options.reach)) {
      for (const uint32_t e : edges_from[near.image]) {
        std::optional<AzimuthVote> vote = VoteOf(edges[e]);
        if (!vote) continue;
        vote->azimuth_rad += near.turn_rad;
        all.push_back(*vote);
        if (edges[e].is_in_sequence) in_sequence.push_back(*vote);
      }
    }
    headings[image] = AgreedAzimuth(std::move(in_sequence), options.agree_rad);
    if (!headings[image]) headings[image] = AgreedAzimuth(std::move(all), options.agree_rad);
  }
  return headings;
}

}  // namespace orbweave
