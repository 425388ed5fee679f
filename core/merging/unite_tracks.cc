// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/unite_tracks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

// Two tracks that share features.
struct Meeting {
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t num_common = 0;
  double error = 0.0;
};

// A feature and a track that holds it.
using Holding = std::pair<FeatureRef, uint32_t>;

std::vector<Holding> SortHoldings(std::span<const Track> tracks) {
  std::vector<Holding> holdings;
  for (uint32_t t = 0; t < tracks.size(); ++t) {
    for (const Observation& observation : tracks[t].observations) {
      holdings.emplace_back(observation.ref, t);
    }
  }
  std::sort(holdings.begin(), holdings.end());
  return holdings;
}

// Calls visit(begin, end) for every feature's run of holdings.
template <typename Visitor>
void ForEachFeature(const std::vector<Holding>& holdings, Visitor&& visit) {
  for (size_t begin = 0; begin < holdings.size();) {
    size_t end = begin + 1;
    while (end < holdings.size() && holdings[end].first == holdings[begin].first) ++end;
    visit(begin, end);
    begin = end;
  }
}

// Error of a point in the cameras that observe a track; 0 where none is registered.
double ErrorIn(const Eigen::Vector3d& point_in_world,
               const Track& track,
               const std::map<ImageId, RegisteredImage>& images) {
  double sum = 0.0;
  double count = 0.0;
  for (const Observation& observation : track.observations) {
    const auto image = images.find(observation.ref.image);
    if (image == images.end()) continue;
    const Eigen::Vector3d ray = image->second.cam_from_world * point_in_world;
    const double angle = AngleBetween(ray, observation.bearing) / observation.sigma_rad;
    sum += angle * angle;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

// Every two tracks with a common feature, most common features first.
std::vector<Meeting> FindMeetings(std::span<const Track> tracks,
                                  const std::vector<Holding>& holdings,
                                  const std::map<ImageId, RegisteredImage>& images) {
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  ForEachFeature(holdings, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      for (size_t j = i + 1; j < end; ++j) {
        pairs.emplace_back(holdings[i].second, holdings[j].second);
      }
    }
  });
  std::sort(pairs.begin(), pairs.end());
  std::vector<Meeting> meetings;
  for (const auto& [x, y] : pairs) {
    if (meetings.empty() || meetings.back().x != x || meetings.back().y != y) {
      const double error = std::max(ErrorIn(tracks[x].point_in_world, tracks[y], images),
                                    ErrorIn(tracks[y].point_in_world, tracks[x], images));
      meetings.push_back({.x = x, .y = y, .error = error});
    }
    ++meetings.back().num_common;
  }
  std::stable_sort(meetings.begin(), meetings.end(), [](const Meeting& p, const Meeting& q) {
    return p.num_common > q.num_common;
  });
  return meetings;
}

double ErrorBound(const std::vector<Meeting>& meetings, double max_error) {
  std::vector<double> errors;
  for (const Meeting& meeting : meetings) errors.push_back(meeting.error);
  return std::max(max_error, 3.0 * Quantile(std::move(errors), 0.5));
}

// Sets of tracks, each with the union of its features.
class TrackSets {
 public:
  explicit TrackSets(std::span<const Track> tracks)
      : sets_(static_cast<uint32_t>(tracks.size())), features_(tracks.size()) {
    for (size_t t = 0; t < tracks.size(); ++t) {
      for (const Observation& observation : tracks[t].observations) {
        features_[t].push_back(observation.ref);
      }
      std::sort(features_[t].begin(), features_[t].end());
    }
  }

  // False when the union would hold two features of one image.
  bool Join(uint32_t x, uint32_t y) {
    x = sets_.Find(x);
    y = sets_.Find(y);
    if (x == y) return true;
    std::vector<FeatureRef> united;
    std::set_union(features_[x].begin(),
                   features_[x].end(),
                   features_[y].begin(),
                   features_[y].end(),
                   std::back_inserter(united));
    const auto clash = std::adjacent_find(
        united.begin(), united.end(), [](const FeatureRef& p, const FeatureRef& q) {
          return p.image == q.image;
        });
    if (clash != united.end()) return false;
    sets_.Unite(x, y);
    features_[x] = {};
    features_[y] = {};
    features_[sets_.Find(x)] = std::move(united);
    return true;
  }

  [[nodiscard]] uint32_t Find(uint32_t track) { return sets_.Find(track); }
  [[nodiscard]] size_t NumFeatures(uint32_t track) { return features_[sets_.Find(track)].size(); }

 private:
  DisjointSets sets_;
  std::vector<std::vector<FeatureRef>> features_;  // of representatives
};

// For every track the position of its set among the results, in order of first members.
std::vector<uint32_t> NumberSets(TrackSets& sets, size_t num_tracks, size_t& num_sets) {
  std::vector<uint32_t> number(num_tracks, 0);
  std::vector<int64_t> number_of_set(num_tracks, -1);
  num_sets = 0;
  for (uint32_t t = 0; t < num_tracks; ++t) {
    int64_t& n = number_of_set[sets.Find(t)];
    if (n < 0) n = static_cast<int64_t>(num_sets++);
    number[t] = static_cast<uint32_t>(n);
  }
  return number;
}

// Points and colours of the sets; observations come later.
std::vector<Track> AveragePoints(std::span<const Track> tracks,
                                 const std::vector<uint32_t>& number,
                                 size_t num_sets,
                                 uint32_t& num_united) {
  std::vector<Track> united(num_sets);
  std::vector<double> weight(num_sets, 0.0);
  std::vector<size_t> longest(num_sets, 0);
  std::vector<uint32_t> num_parts(num_sets, 0);
  for (size_t t = 0; t < tracks.size(); ++t) {
    const uint32_t n = number[t];
    const auto w = static_cast<double>(tracks[t].observations.size());
    united[n].point_in_world += w * tracks[t].point_in_world;
    weight[n] += w;
    if (tracks[t].observations.size() > longest[n]) {
      longest[n] = tracks[t].observations.size();
      united[n].color = tracks[t].color;
    }
    if (++num_parts[n] == 2) ++num_united;
  }
  for (size_t n = 0; n < num_sets; ++n) {
    if (weight[n] > 0.0) united[n].point_in_world /= weight[n];
  }
  return united;
}

const Observation& ObservationOf(const Track& track, const FeatureRef& ref) {
  return *std::find_if(track.observations.begin(),
                       track.observations.end(),
                       [&](const Observation& observation) { return observation.ref == ref; });
}

// Gives each feature of a registered image to the largest set that holds it.
void AssignObservations(std::span<const Track> tracks,
                        const std::vector<Holding>& holdings,
                        const std::map<ImageId, RegisteredImage>& images,
                        const std::vector<uint32_t>& number,
                        TrackSets& sets,
                        std::vector<Track>& united) {
  ForEachFeature(holdings, [&](size_t begin, size_t end) {
    const FeatureRef& ref = holdings[begin].first;
    if (!images.contains(ref.image)) return;
    uint32_t owner = holdings[begin].second;
    for (size_t i = begin + 1; i < end; ++i) {
      if (sets.NumFeatures(holdings[i].second) > sets.NumFeatures(owner))
        owner = holdings[i].second;
    }
    united[number[owner]].observations.push_back(ObservationOf(tracks[owner], ref));
  });
}

}  // namespace

UnitedTracks UniteTracks(std::span<const Track> tracks,
                         const std::map<ImageId, RegisteredImage>& images,
                         double max_error) {
  UnitedTracks result;
  const std::vector<Holding> holdings = SortHoldings(tracks);
  const std::vector<Meeting> meetings = FindMeetings(tracks, holdings, images);
  const double bound = ErrorBound(meetings, max_error);
  TrackSets sets(tracks);
  for (const Meeting& meeting : meetings) {
    if (meeting.error > bound || !sets.Join(meeting.x, meeting.y)) ++result.num_conflicting;
  }
  size_t num_sets = 0;
  const std::vector<uint32_t> number = NumberSets(sets, tracks.size(), num_sets);
  result.tracks = AveragePoints(tracks, number, num_sets, result.num_united);
  AssignObservations(tracks, holdings, images, number, sets, result.tracks);
  std::erase_if(result.tracks, [](const Track& track) { return track.observations.size() < 2; });
  std::sort(result.tracks.begin(), result.tracks.end(), [](const Track& x, const Track& y) {
    return x.Name() < y.Name();
  });
  return result;
}

}  // namespace orbweave
