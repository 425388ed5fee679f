// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/parts_of_one_scale.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "core/graph/disjoint_sets.h"
#include "core/mapping/cuts/stations.h"
#include "core/scene/reconstruction.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using Triplet = std::array<ImageSlot, 3>;  ///< first images of stations, ascending

/// Of stations that see a point so many take part.
constexpr size_t kMostStations = 10;
constexpr double kShareOfMinAngle = 2.0 / 3.0;
/// Of that angle: what stands nearer to each other is one station.
constexpr double kShareOfStation = 0.2;

/// A station that sees a point, and from where.
struct Sight {
  ImageSlot station = 0;                   ///< its first image
  uint32_t rank = 0;                       ///< of the station
  Vector3d direction = Vector3d::UnitZ();  ///< unit, from the point
};

/// Whether of two stations that see many points the first is to take part rather: those whose rank
/// a higher power of two divides, so that neighbouring points take the same ones.
bool IsPreferred(const Sight& one, const Sight& other) {
  const auto power = [](const Sight& sight) { return std::countr_zero(sight.rank); };
  return std::pair(-power(one), one.rank) < std::pair(-power(other), other.rank);
}

/// In order of stations.
std::vector<Sight> SightsOf(const MappingState& state, const Stations& stations, PointIndex point) {
  std::vector<Sight> sights;
  for (const ImageSlot image : ImagesThatSee(state, point)) {
    const ImageSlot station = stations.FirstOf(image);
    if (std::ranges::find(sights, station, &Sight::station) != sights.end()) continue;
    sights.push_back({station,
                      stations.RankOf(image),
                      (state.Centre(image) - state.Point(point).position).normalized()});
  }
  if (sights.size() > kMostStations) {
    std::ranges::sort(sights, IsPreferred);
    sights.resize(kMostStations);
  }
  std::ranges::sort(sights, {}, &Sight::station);
  return sights;
}

/// The other two stations of triplets, one entry for each point, by the first of the three.
using OthersOfFirst = std::vector<std::vector<std::pair<ImageSlot, ImageSlot>>>;

/// Each three of the sights of a point of which each two are wide apart.
void AddTriplets(const std::vector<Sight>& sights, double max_cosine, OthersOfFirst& seen) {
  const auto is_wide = [&](size_t i, size_t j) {
    return sights[i].direction.dot(sights[j].direction) < max_cosine;
  };
  for (size_t i = 0; i < sights.size(); ++i) {
    for (size_t j = i + 1; j < sights.size(); ++j) {
      if (!is_wide(i, j)) continue;
      for (size_t k = j + 1; k < sights.size(); ++k) {
        if (is_wide(i, k) && is_wide(j, k))
          seen[sights[i].station].emplace_back(sights[j].station, sights[k].station);
      }
    }
  }
}

/// Each three stations of which enough points tell, ascending.
std::vector<Triplet> ToldTriplets(const MappingState& state,
                                  const Stations& stations,
                                  double min_angle_rad) {
  const double max_cosine = std::cos(min_angle_rad);
  OthersOfFirst seen(state.Graph().NumImages());
  for (PointIndex p = 0; p < state.EndOfPoints(); ++p)
    AddTriplets(SightsOf(state, stations, p), max_cosine, seen);
  std::vector<Triplet> told;
  for (ImageSlot first = 0; first < seen.size(); ++first) {
    std::ranges::sort(seen[first]);
    for (auto run = seen[first].begin(); run != seen[first].end();) {
      const auto end = std::upper_bound(run, seen[first].end(), *run);
      if (end - run >= kFewestThatTellSize) told.push_back({first, run->first, run->second});
      run = end;
    }
  }
  return told;
}

using Part = std::set<ImageSlot>;

/// Baselines that triplets hold together, as the images at their ends.
std::vector<Part> PartsOfTriplets(const std::vector<Triplet>& told) {
  std::map<std::pair<ImageSlot, ImageSlot>, uint32_t> number_of_baseline;
  std::vector<std::array<uint32_t, 3>> held;
  const auto number = [&](ImageSlot a, ImageSlot b) {
    const auto next = static_cast<uint32_t>(number_of_baseline.size());
    return number_of_baseline.try_emplace({a, b}, next).first->second;
  };
  for (const auto& [a, b, c] : told) held.push_back({number(a, b), number(b, c), number(a, c)});
  DisjointSets sets(static_cast<uint32_t>(number_of_baseline.size()));
  for (const auto& [ab, bc, ac] : held) {
    sets.Unite(ab, bc);
    sets.Unite(ab, ac);
  }
  std::map<uint32_t, Part> part_of_set;
  for (const auto& [baseline, index] : number_of_baseline)
    part_of_set[sets.Find(index)].insert({baseline.first, baseline.second});
  std::vector<Part> parts;
  for (auto& [set, part] : part_of_set) parts.push_back(std::move(part));
  return parts;
}

bool ShareABaseline(const Part& one, const Part& other) {
  size_t common = 0;
  for (const ImageSlot image : one) common += other.contains(image) ? 1 : 0;
  return common >= 2;
}

/// Unites parts that have two images in common until none have.
void UniteThatShareABaseline(std::vector<Part>& parts) {
  for (bool has_united = true; has_united;) {
    has_united = false;
    for (auto one = parts.begin(); one != parts.end(); ++one) {
      for (auto other = std::next(one); other != parts.end();) {
        if (!ShareABaseline(*one, *other)) {
          ++other;
          continue;
        }
        one->insert(other->begin(), other->end());
        other = parts.erase(other);
        has_united = true;
      }
    }
  }
}

Part ImagesOfStations(const MappingState& state, const Stations& stations, const Part& part) {
  Part images;
  for (const ImageSlot image : state.Registered()) {
    if (part.contains(stations.FirstOf(image))) images.insert(image);
  }
  return images;
}

void SortLargestFirst(std::vector<Part>& parts) {
  std::ranges::stable_sort(parts, [](const Part& x, const Part& y) {
    return std::pair(y.size(), *x.begin()) < std::pair(x.size(), *y.begin());
  });
}

/// Each image in one part, the larger one; none smaller than `smallest`.
std::vector<Part> WithoutHinges(std::vector<Part> parts, size_t smallest) {
  SortLargestFirst(parts);
  Part taken;
  std::vector<Part> kept;
  for (Part& part : parts) {
    std::erase_if(part, [&](ImageSlot image) { return taken.contains(image); });
    if (part.size() < smallest) continue;
    taken.insert(part.begin(), part.end());
    kept.push_back(std::move(part));
  }
  return kept;
}

/// Puts images that are in no part to the one that they have most points in common with, those with
/// most first.
class Adding {
 public:
  Adding(const MappingState& state, std::vector<Part>& parts)
      : state_(state), parts_(parts), number_of_(state.Graph().NumImages()) {
    for (size_t number = 0; number < parts.size(); ++number) {
      for (const ImageSlot image : parts[number]) number_of_[image] = number;
    }
    for (const ImageSlot image : state.Registered()) {
      if (!number_of_[image]) left_.insert(image);
    }
  }

  void AddAll() {
    while (!left_.empty()) AddNext();
  }

 private:
  void AddNext() {
    std::map<std::pair<ImageSlot, size_t>, size_t> common;
    for (PointIndex p = 0; p < state_.EndOfPoints(); ++p) CountCommon(p, common);
    const auto most =
        std::ranges::max_element(common, {}, [](const auto& entry) { return entry.second; });
    const ImageSlot image = most == common.end() ? *left_.begin() : most->first.first;
    const size_t number = most == common.end() ? 0 : most->first.second;
    parts_[number].insert(image);
    number_of_[image] = number;
    left_.erase(image);
  }

  void CountCommon(PointIndex point, std::map<std::pair<ImageSlot, size_t>, size_t>& common) const {
    const std::vector<ImageSlot> images = ImagesThatSee(state_, point);
    std::set<size_t> parts;
    for (const ImageSlot image : images) {
      if (number_of_[image]) parts.insert(*number_of_[image]);
    }
    for (const ImageSlot image : images) {
      if (!left_.contains(image)) continue;
      for (const size_t part : parts) ++common[{image, part}];
    }
  }

  const MappingState& state_;
  std::vector<Part>& parts_;
  std::vector<std::optional<size_t>> number_of_;
  std::set<ImageSlot> left_{};
};

}  // namespace

std::vector<std::vector<ImageSlot>> PartsOfOneScale(const MappingState& state,
                                                    const MappingOptions& options) {
  const double min_angle_rad = kShareOfMinAngle * options.min_angle_deg / 180.0 * std::numbers::pi;
  const Stations stations(state, kShareOfStation * min_angle_rad);
  std::vector<Part> parts = PartsOfTriplets(ToldTriplets(state, stations, min_angle_rad));
  UniteThatShareABaseline(parts);
  for (Part& part : parts) part = ImagesOfStations(state, stations, part);
  parts = WithoutHinges(std::move(parts), static_cast<size_t>(options.min_component_images));
  if (parts.size() < 2) parts = {Part(state.Registered().begin(), state.Registered().end())};
  Adding(state, parts).AddAll();
  SortLargestFirst(parts);
  std::vector<std::vector<ImageSlot>> listed;
  for (const Part& part : parts) listed.emplace_back(part.begin(), part.end());
  return listed;
}

}  // namespace orbweave
