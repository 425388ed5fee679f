// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/bridges/join_by_bridges.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/adjustment/adjust_local.h"
#include "core/mapping/bridges/bridge_terms.h"
#include "core/mapping/bridges/find_bridge.h"
#include "core/mapping/growth/grow_submodel.h"
#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/model/reconstructed_share.h"
#include "core/mapping/model/triangulate_tracks.h"

namespace orbweave {
namespace {

/// Bridges are good to some hundredths of a step: points between are first made under limits so
/// many times as wide.
constexpr double kSlack = 4.0;
constexpr double kMinKeptImages = 0.9;
/// As registration asks of the points that an image should see.
constexpr double kMinCommonMatches = 0.25;

/// Registers the images of `b` in `a` and takes its points over.
void TakeOver(const MappingState& b, const Sim3& a_from_b, MappingState& a) {
  for (const ImageSlot image : b.Registered())
    a.Register(image, TransformCamera(a_from_b, b.CamFromWorld(image)));
  for (const PointIndex point : AllPoints(b))
    a.AddPoint(a_from_b * b.Point(point).position, b.Point(point).nodes);
}

class Joining {
 public:
  Joining(const ClusterProblem& problem,
          const CorrespondenceGraph& graph,
          const MappingOptions& options,
          RegistrationLog& log,
          const StageContext& context)
      : problem_(problem), graph_(graph), options_(options), log_(log), context_(context) {}

  absl::StatusOr<std::vector<MappingState>> Run(std::vector<MappingState> submodels) {
    for (MappingState& submodel : submodels) Add(std::move(submodel));
    AddSingleImages();
    ORBWEAVE_RETURN_IF_ERROR(JoinAll());
    std::vector<MappingState> joined;
    for (auto& [key, submodel] : submodels_) {
      if (submodel.Registered().size() > 1) joined.push_back(std::move(submodel));
    }
    return joined;
  }

 private:
  using Key = uint32_t;  ///< a new one for every state of a submodel

  Key Add(MappingState submodel) {
    const Key key = next_key_++;
    for (const ImageSlot image : submodel.Registered()) submodel_of_[image] = key;
    submodels_.emplace(key, std::move(submodel));
    return key;
  }

  void AddSingleImages() {
    for (ImageSlot image = 0; image < graph_.NumImages(); ++image) {
      if (submodel_of_.contains(image) || graph_.pairs_of_image[image].empty()) continue;
      MappingState single(problem_, graph_);
      single.Register(image, Rigid3{});
      Add(std::move(single));
    }
  }

  /// Pairs of submodels by the matches between them, most first.
  [[nodiscard]] std::vector<std::pair<Key, Key>> Candidates() const {
    std::map<std::pair<Key, Key>, size_t> matches;
    for (const LinkedPair& pair : graph_.pairs) {
      const auto a = submodel_of_.find(pair.a);
      const auto b = submodel_of_.find(pair.b);
      if (a == submodel_of_.end() || b == submodel_of_.end() || a->second == b->second) continue;
      matches[std::minmax(a->second, b->second)] += problem_.pairs[pair.index].inliers.size();
    }
    std::vector<std::pair<Key, Key>> candidates;
    for (const auto& [keys, count] : matches) {
      if (!failed_.contains(keys)) candidates.push_back(keys);
    }
    std::stable_sort(candidates.begin(), candidates.end(), [&](const auto& x, const auto& y) {
      return matches.at(x) > matches.at(y);
    });
    return candidates;
  }

  absl::Status JoinAll() {
    for (bool has_joined = true; has_joined;) {
      has_joined = false;
      for (const auto& keys : Candidates()) {
        ORBWEAVE_RETURN_IF_ERROR(context_.CheckStop());
        ORBWEAVE_ASSIGN_OR_RETURN(has_joined, Join(keys));
        if (has_joined) break;
        failed_.insert(keys);
      }
    }
    return absl::OkStatus();
  }

  absl::StatusOr<bool> Join(const std::pair<Key, Key>& keys) {
    // The larger is the frame.
    Key large = keys.first;
    Key small = keys.second;
    if (submodels_.at(large).Registered().size() < submodels_.at(small).Registered().size())
      std::swap(large, small);
    const MappingState& a = submodels_.at(large);
    const MappingState& b = submodels_.at(small);
    if (a.Registered().size() == 1) return false;
    const std::optional<Sim3> a_from_b = FindBridge(a, b, options_);
    if (!a_from_b) return false;
    MappingState joined = a;
    TakeOver(b, *a_from_b, joined);
    const std::vector<BridgePair> bridges = BridgePairsOf(a, b);
    ORBWEAVE_RETURN_IF_ERROR(Settle(joined, bridges, b));
    if (!Holds(joined, bridges, a, b)) return false;
    ORBWEAVE_RETURN_IF_ERROR(Grow(joined, large, small));
    for (const Key key : {large, small}) Remove(key);
    Add(std::move(joined));
    return true;
  }

  /// Points between both sides, and all adjusted to them; around a single image what is near.
  absl::Status Settle(MappingState& joined,
                      const std::vector<BridgePair>& bridges,
                      const MappingState& b) {
    const TrackLimits limits = LimitsOf(options_);
    const TrackLimits wide{.max_error_px = kSlack * limits.max_error_px,
                           .min_angle_deg = limits.min_angle_deg};
    std::set<ImageSlot> ends;
    for (const BridgePair& bridge : bridges) ends.insert({bridge.in_a, bridge.in_b});
    for (const ImageSlot image : ends) TriangulateImage(joined, image, wide);
    if (b.Registered().size() == 1)
      return AdjustLocally(joined, b.Registered().front(), options_, context_);
    return AdjustGrowingModel(joined, options_, context_);
  }

  [[nodiscard]] bool Holds(const MappingState& joined,
                           const std::vector<BridgePair>& bridges,
                           const MappingState& a,
                           const MappingState& b) const {
    const auto has_points = [&](ImageSlot image) {
      return joined.NumObservations(image) >= static_cast<uint32_t>(options_.min_inliers);
    };
    const auto kept = static_cast<size_t>(std::ranges::count_if(joined.Registered(), has_points));
    size_t matches = 0;
    size_t common = 0;
    for (const BridgePair& bridge : bridges) {
      matches += bridge.matches;
      common += CountReconstructed(joined, graph_.pairs[bridge.pair]);
    }
    return static_cast<double>(kept) >=
               kMinKeptImages *
                   static_cast<double>(a.Registered().size() + b.Registered().size()) &&
           common >= static_cast<size_t>(options_.min_inliers) &&
           static_cast<double>(common) >= kMinCommonMatches * static_cast<double>(matches);
  }

  /// Images that no submodel of several holds may join now.
  absl::Status Grow(MappingState& joined, Key large, Key small) {
    std::vector<uint8_t> available(graph_.NumImages(), 1);
    for (const auto& [image, key] : submodel_of_) {
      const bool is_other = key != large && key != small;
      if (is_other && submodels_.at(key).Registered().size() > 1) available[image] = 0;
    }
    ResetAttempts(log_);
    ORBWEAVE_RETURN_IF_ERROR(GrowSubmodel(joined, available, options_, log_, context_).status());
    for (const ImageSlot image : joined.Registered()) {
      const auto single = submodel_of_.find(image);
      if (single == submodel_of_.end() || single->second == large || single->second == small)
        continue;
      Remove(single->second);
    }
    return absl::OkStatus();
  }

  void Remove(Key key) {
    for (const ImageSlot image : submodels_.at(key).Registered()) submodel_of_.erase(image);
    submodels_.erase(key);
  }

  const ClusterProblem& problem_;
  const CorrespondenceGraph& graph_;
  const MappingOptions& options_;
  RegistrationLog& log_;
  const StageContext& context_;
  std::map<Key, MappingState> submodels_{};
  std::map<ImageSlot, Key> submodel_of_{};
  std::set<std::pair<Key, Key>> failed_{};
  Key next_key_ = 0;
};

}  // namespace

absl::StatusOr<std::vector<MappingState>> JoinByBridges(std::vector<MappingState> submodels,
                                                        const ClusterProblem& problem,
                                                        const CorrespondenceGraph& graph,
                                                        const MappingOptions& options,
                                                        RegistrationLog& log,
                                                        const StageContext& context) {
  return Joining(problem, graph, options, log, context).Run(std::move(submodels));
}

}  // namespace orbweave
