// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/choose_wider_pairs.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <utility>
#include <vector>

#include "core/graph/disjoint_sets.h"
#include "core/graph/predict_pairs.h"
#include "core/scene/places_in_drives.h"

namespace orbweave {
namespace {

using Pairs = std::vector<ImagePair>;

/// Matches that moved, several times what a geometry needs.
constexpr uint32_t kManyMoved = 50;
/// Parts with fewer images than this may be held together with others by what was not tried.
constexpr uint32_t kSmallPart = 16;

bool IsStrong(const MatchedPair& pair) {
  return pair.kind == TwoViewKind::kGeneral && IsBeyondDoubt(pair) && pair.num_moved >= kManyMoved;
}

/// Who is joined to whom. Lists of neighbours stay sorted.
class Links {
 public:
  explicit Links(size_t num_images) : of_(num_images) {}

  void Add(const ImagePair& pair) {
    Insert(of_[pair.a.value], pair.b);
    Insert(of_[pair.b.value], pair.a);
  }
  [[nodiscard]] bool AreJoinedByTwo(const ImagePair& pair) const {
    return Meet(of_[pair.a.value], of_[pair.b.value]) ||
           std::ranges::binary_search(of_[pair.a.value], pair.b);
  }
  /// By at most four links.
  [[nodiscard]] bool AreChained(const ImagePair& pair) const {
    return Meet(WithinTwo(pair.a), WithinTwo(pair.b));
  }

 private:
  using Ids = std::vector<ImageId>;

  static void Insert(Ids& ids, ImageId id) { ids.insert(std::ranges::upper_bound(ids, id), id); }
  static bool Meet(const Ids& some, const Ids& others) {
    auto other = others.begin();
    return std::ranges::any_of(some, [&](ImageId id) {
      other = std::lower_bound(other, others.end(), id);
      return other != others.end() && *other == id;
    });
  }
  [[nodiscard]] Ids WithinTwo(ImageId image) const {
    Ids ids = of_[image.value];
    for (const ImageId next : of_[image.value])
      ids.insert(ids.end(), of_[next.value].begin(), of_[next.value].end());
    ids.push_back(image);
    std::ranges::sort(ids);
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  std::vector<Ids> of_;
};

void DecideAboutSecond(const ImageManifest& manifest,
                       const Pairs& candidates,
                       std::span<const MatchedPair> matched,
                       const PairOptions& options,
                       WiderPairs& wider) {
  Links strong(manifest.images.size());
  for (const MatchedPair& pair : matched) {
    if (IsStrong(pair)) strong.Add(pair.pair);
  }
  Links dense = strong;
  const PlacesInDrives places(manifest);
  const auto window = static_cast<uint32_t>(options.sequence_window);
  std::vector<std::pair<uint32_t, ImagePair>> by_steps;
  for (const ImagePair& pair : candidates)
    by_steps.emplace_back(places.StepsBetween(pair).value_or(0), pair);
  std::ranges::sort(by_steps);
  for (const auto& [apart, pair] : by_steps) {
    const bool is_of_chain = apart > 0 && apart <= window && strong.AreChained(pair);
    if (is_of_chain && dense.AreJoinedByTwo(pair)) {
      ++wider.num_held_back;
      continue;
    }
    if (is_of_chain) dense.Add(pair);
    wider.second.push_back(pair);
  }
  std::ranges::sort(wider.second);
}

/// Per image: it has few verified pairs, or hangs together with few images.
std::vector<bool> ThinImages(size_t num_images,
                             std::span<const MatchedPair> matched,
                             int thin_below) {
  std::vector<uint32_t> degree(num_images, 0);
  DisjointSets parts(static_cast<uint32_t>(num_images));
  for (const MatchedPair& pair : matched) {
    ++degree[pair.pair.a.value];
    ++degree[pair.pair.b.value];
    parts.Unite(pair.pair.a.value, pair.pair.b.value);
  }
  std::vector<bool> is_thin(num_images);
  for (uint32_t image = 0; image < num_images; ++image) {
    const uint32_t part = parts.SizeOf(image);
    is_thin[image] = degree[image] < static_cast<uint32_t>(thin_below) ||
                     (part < kSmallPart && part < num_images);
  }
  return is_thin;
}

/// What was held back comes first for images that turn out thin without it: it is nearer than the
/// reserve.
void DecideAboutReserve(const ImageManifest& manifest,
                        const PairCandidates& candidates,
                        std::span<const MatchedPair> matched,
                        const PairOptions& options,
                        WiderPairs& wider) {
  Pairs held_back;
  std::ranges::set_difference(candidates.second, wider.second, std::back_inserter(held_back));
  if (options.thin_below == 0 || held_back.size() + candidates.reserve.size() == 0) return;
  const std::vector<bool> is_thin = ThinImages(manifest.images.size(), matched, options.thin_below);
  wider.num_thin_images = static_cast<uint32_t>(std::ranges::count(is_thin, true));
  const auto is_wanted = [&](const ImagePair& pair) {
    return is_thin[pair.a.value] || is_thin[pair.b.value];
  };
  std::ranges::copy_if(held_back, std::back_inserter(wider.reserve), is_wanted);
  wider.num_held_back -= static_cast<uint32_t>(wider.reserve.size());
  std::ranges::copy_if(candidates.reserve, std::back_inserter(wider.reserve), is_wanted);
  std::ranges::sort(wider.reserve);
}

void DecideAboutPredicted(const ImageManifest& manifest,
                          const PairCandidates& candidates,
                          std::span<const MatchedPair> matched,
                          WiderPairs& wider) {
  Pairs tried = candidates.first;
  for (const Pairs* pairs : {&wider.second, &wider.reserve})
    tried.insert(tried.end(), pairs->begin(), pairs->end());
  wider.predicted = PredictPairs(tried, matched, manifest.images.size());
}

}  // namespace

WiderPairs ChooseWiderPairs(const ImageManifest& manifest,
                            const PairCandidates& candidates,
                            std::span<const MatchedPair> matched,
                            const WiderPairs& before,
                            const PairOptions& options) {
  WiderPairs wider = before;
  if (wider.decisions == 0) {
    wider.decisions = 1;
    DecideAboutSecond(manifest, candidates.second, matched, options, wider);
    if (!wider.second.empty()) return wider;
  }
  if (wider.decisions == 1) {
    wider.decisions = 2;
    DecideAboutReserve(manifest, candidates, matched, options, wider);
    if (!wider.reserve.empty()) return wider;
  }
  if (wider.decisions == 2) {
    wider.decisions = 3;
    if (options.predict) DecideAboutPredicted(manifest, candidates, matched, wider);
  }
  return wider;
}

}  // namespace orbweave
