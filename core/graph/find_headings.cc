// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/find_headings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/graph/azimuth.h"

namespace orbweave {
namespace {

// Of cameras that stand upright to some degrees.
constexpr double kTilt_rad = 5.0 * std::numbers::pi / 180.0;
constexpr size_t kFewest = 3;

struct Vote {
  double heading_rad = 0.0;
  double sigma_rad = 0.0;
  double weight = 0.0;
};

/// Of camera a.
std::optional<Vote> VoteOf(const MotionEdge& edge) {
  if (!edge.step || !edge.step->IsTelling()) return std::nullopt;
  const double sigma_rad = std::hypot(edge.step->sigma_m / edge.step->distance_m, kTilt_rad);
  return Vote{edge.step->HeadingOfA(), sigma_rad, edge.weight / sigma_rad};
}

/// The votes within `agree_rad` of one of them that weigh most: [first, first + count) of `votes`,
/// which are sorted and come three times, each time a turn further.
struct Window {
  size_t first = 0;
  size_t count = 0;
  double weight = 0.0;
};

Window HeaviestWindow(const std::vector<Vote>& votes, size_t num_votes, double agree_rad) {
  Window best;
  size_t first = 0;
  size_t end = 0;
  double weight = 0.0;
  for (size_t centre = 0; centre < num_votes; ++centre) {
    // Centres are the votes of the second time, so that a window begins and ends among them.
    const double heading_rad = votes[centre + num_votes].heading_rad;
    while (end < votes.size() && votes[end].heading_rad <= heading_rad + agree_rad)
      weight += votes[end++].weight;
    while (votes[first].heading_rad < heading_rad - agree_rad) weight -= votes[first++].weight;
    if (weight > best.weight) best = {first, end - first, weight};
  }
  return best;
}

std::optional<double> HeadingOf(std::vector<Vote> votes, double agree_rad) {
  if (votes.size() < kFewest) return std::nullopt;
  double all = 0.0;
  for (Vote& vote : votes) {
    vote.heading_rad = WrappedAzimuth(vote.heading_rad);
    all += vote.weight;
  }
  std::ranges::stable_sort(votes, {}, &Vote::heading_rad);
  const size_t num_votes = votes.size();
  for (const int turn : {1, 2}) {
    for (size_t i = 0; i < num_votes; ++i) {
      Vote again = votes[i];
      again.heading_rad += turn * 2.0 * std::numbers::pi;
      votes.push_back(again);
    }
  }
  const Window window = HeaviestWindow(votes, num_votes, agree_rad);
  if (window.count < kFewest || !(window.weight > 0.5 * all)) return std::nullopt;
  double sum = 0.0;
  double weights = 0.0;
  for (size_t i = window.first; i < window.first + window.count; ++i) {
    const double weight = votes[i].weight / votes[i].sigma_rad;
    sum += weight * votes[i].heading_rad;
    weights += weight;
  }
  return sum / weights;
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
    std::vector<Vote> in_sequence;
    std::vector<Vote> all;
    for (const TurnForest::Link& near : forest.Around(image, options.reach)) {
      for (const uint32_t e : edges_from[near.image]) {
        std::optional<Vote> vote = VoteOf(edges[e]);
        if (!vote) continue;
        vote->heading_rad += near.turn_rad;
        all.push_back(*vote);
        if (edges[e].is_in_sequence) in_sequence.push_back(*vote);
      }
    }
    headings[image] = HeadingOf(std::move(in_sequence), options.agree_rad);
    if (!headings[image]) headings[image] = HeadingOf(std::move(all), options.agree_rad);
  }
  return headings;
}

}  // namespace orbweave
