// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/meeting_places.h"

#include <algorithm>
#include <optional>

#include "core/graph/disjoint_sets.h"
#include "core/graph/strong_links.h"

namespace orbweave {
namespace {

struct Cut {
  std::vector<CutEdge> strong{};
  std::vector<CutEdge> weak{};
};

using Cuts = std::map<std::pair<uint32_t, uint32_t>, Cut>;

Cuts FindCuts(const Adjacency& adjacency,
              const StrongLinks& strong,
              std::span<const uint32_t> part_of) {
  Cuts cuts;
  for (uint32_t image = 0; image < adjacency.num_images(); ++image) {
    for (const Adjacency::Link& link : adjacency.Of(image)) {
      if (part_of[image] >= part_of[link.image])
        continue;  // each cut edge once, from its lower part
      Cut& cut = cuts[{part_of[image], part_of[link.image]}];
      (strong.Has(image, link) ? cut.strong : cut.weak).push_back({image, link.image, link.edge});
    }
  }
  return cuts;
}

// The images of strong cut edges, in groups that strong links hold together.
class Frontier {
 public:
  Frontier(const Adjacency& adjacency, const StrongLinks& strong, const std::vector<CutEdge>& cut)
      : images_(ImagesOf(cut)), groups_(static_cast<uint32_t>(images_.size())) {
    for (uint32_t i = 0; i < images_.size(); ++i) {
      for (const Adjacency::Link& link : adjacency.Of(images_[i])) {
        const std::optional<uint32_t> other = IndexOf(link.image);
        if (other && strong.Has(images_[i], link)) groups_.Unite(i, *other);
      }
    }
  }

  // The group at an end of the edge.
  [[nodiscard]] std::optional<uint32_t> GroupOf(const CutEdge& edge) {
    for (const uint32_t image : {edge.in_a, edge.in_b}) {
      if (const std::optional<uint32_t> index = IndexOf(image)) return groups_.Find(*index);
    }
    return std::nullopt;
  }

 private:
  static std::vector<uint32_t> ImagesOf(const std::vector<CutEdge>& cut) {
    std::vector<uint32_t> images;
    for (const CutEdge& edge : cut) {
      images.push_back(edge.in_a);
      images.push_back(edge.in_b);
    }
    std::ranges::sort(images);
    const auto rest = std::ranges::unique(images);
    images.erase(rest.begin(), rest.end());
    return images;
  }

  [[nodiscard]] std::optional<uint32_t> IndexOf(uint32_t image) const {
    const auto found = std::ranges::lower_bound(images_, image);
    if (found == images_.end() || *found != image) return std::nullopt;
    return static_cast<uint32_t>(found - images_.begin());
  }

  std::vector<uint32_t> images_;  // sorted
  DisjointSets groups_;           // of positions in images_
};

std::vector<MeetingPlace> PlacesOf(const Adjacency& adjacency, const StrongLinks& strong, Cut cut) {
  if (cut.strong.empty()) return {std::move(cut.weak)};
  Frontier frontier(adjacency, strong, cut.strong);
  std::map<uint32_t, size_t> place_of_group;
  std::vector<MeetingPlace> places;
  for (const CutEdge& edge : cut.strong) {
    const auto [entry, is_new] = place_of_group.try_emplace(*frontier.GroupOf(edge), places.size());
    if (is_new) places.emplace_back();
    places[entry->second].push_back(edge);
  }
  for (const CutEdge& edge : cut.weak) {
    if (const std::optional<uint32_t> group = frontier.GroupOf(edge))
      places[place_of_group.at(*group)].push_back(edge);
  }
  return places;
}

}  // namespace

std::map<std::pair<uint32_t, uint32_t>, std::vector<MeetingPlace>> FindMeetingPlaces(
    const Adjacency& adjacency,
    std::span<const double> edge_weight,
    std::span<const uint32_t> part_of) {
  const StrongLinks strong(adjacency, edge_weight);
  std::map<std::pair<uint32_t, uint32_t>, std::vector<MeetingPlace>> places;
  for (auto& [parts, cut] : FindCuts(adjacency, strong, part_of))
    places.emplace(parts, PlacesOf(adjacency, strong, std::move(cut)));
  return places;
}

}  // namespace orbweave
