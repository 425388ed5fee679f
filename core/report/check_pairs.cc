// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_pairs.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace orbweave {
namespace {

constexpr uint32_t kNeighbours = 2;  // places apart in a drive
constexpr size_t kRun = 3;
constexpr double kBadShare = 0.02;  // one in fifty, as in CheckSequenceSteps

/// Where each image is in its drive.
struct Place {
  uint32_t drive = 0;
  uint32_t position = 0;
};

std::vector<Place> PlacesOf(const ImageManifest& manifest) {
  std::map<uint32_t, uint32_t> next;
  std::vector<Place> places;
  for (const ImageRecord& image : manifest.images)
    places.push_back({image.drive, next[image.drive]++});
  return places;
}

bool FollowOneAnother(const std::vector<Place>& places, const ImagePair& pair) {
  const Place& a = places[pair.a.value];
  const Place& b = places[pair.b.value];
  return a.drive == b.drive && b.position - a.position <= kNeighbours;
}

/// Sets of judged pairs. A pair of two clusters that one of them contradicts is contradicted.
struct Judged {
  std::set<ImagePair> explained{};
  std::set<ImagePair> contradicted{};
};

Judged JudgedPairsOf(const JobResults& results) {
  Judged judged;
  for (const ClusterSummary& cluster : results.clusters) {
    judged.explained.insert(cluster.explained_pairs.begin(), cluster.explained_pairs.end());
    judged.contradicted.insert(cluster.contradicted_pairs.begin(),
                               cluster.contradicted_pairs.end());
  }
  const auto is_unknown = [&](const ImagePair& pair) {
    return pair.b.value >= results.manifest.images.size();
  };
  std::erase_if(judged.contradicted, is_unknown);
  std::erase_if(judged.explained, [&](const ImagePair& pair) {
    return is_unknown(pair) || judged.contradicted.contains(pair);
  });
  return judged;
}

/// Whether GNSS puts the two images further apart than three of its sigmas: they only look alike.
bool ArePutApart(const ImageManifest& manifest, const ImagePair& pair) {
  constexpr double kSigmas = 3.0;
  const PosePrior& a = manifest.At(pair.a).prior;
  const PosePrior& b = manifest.At(pair.b).prior;
  if (!a.position_in_enu || !b.position_in_enu) return false;
  const double distance_m = (*a.position_in_enu - *b.position_in_enu).head<2>().norm();
  const double reach_m = 50.0;  // further than panoramas of one place see in common
  return distance_m > reach_m + kSigmas * (a.horizontal_sigma_m + b.horizontal_sigma_m);
}

/// How many pairs from `first` on follow one another on both sides.
size_t RunFrom(const std::set<ImagePair>& pairs, const ImagePair& first, bool same_way) {
  size_t length = 1;
  ImagePair next = first;
  while (true) {
    next.a = ImageId(next.a.value + 1);
    if (!same_way && next.b.value == 0) break;
    next.b = ImageId(same_way ? next.b.value + 1 : next.b.value - 1);
    if (!(next.a < next.b) || !pairs.contains(next)) break;
    ++length;
  }
  return length;
}

size_t LongestRun(const std::set<ImagePair>& pairs) {
  size_t longest = 0;
  for (const ImagePair& pair : pairs) {
    for (const bool same_way : {true, false}) {
      const uint32_t back = same_way ? 1U : 0U;
      const bool has_before =
          pair.a.value > 0 &&
          pairs.contains({ImageId(pair.a.value - 1),
                          ImageId(back != 0 ? pair.b.value - 1 : pair.b.value + 1)});
      if (!has_before) longest = std::max(longest, RunFrom(pairs, pair, same_way));
    }
  }
  return longest;
}

std::string NamesOf(const ImageManifest& manifest, const ImagePair& pair) {
  return manifest.At(pair.a).name + " and " + manifest.At(pair.b).name;
}

}  // namespace

CrossCheck CheckPairs(const JobResults& results) {
  const std::vector<Place> places = PlacesOf(results.manifest);
  const Judged judged = JudgedPairsOf(results);
  const auto follow = [&](const ImagePair& pair) { return FollowOneAnother(places, pair); };
  const auto explained = static_cast<size_t>(std::ranges::count_if(judged.explained, follow));
  std::vector<ImagePair> torn;
  std::set<ImagePair> far;
  for (const ImagePair& pair : judged.contradicted) {
    if (follow(pair)) {
      torn.push_back(pair);
    } else if (!ArePutApart(results.manifest, pair)) {
      far.insert(pair);
    }
  }
  CrossCheck check{
      .name = "pairs_explained", .value = 1.0, .limit = 1.0 - kBadShare, .unit = "share"};
  const size_t all = explained + torn.size();
  if (all > 0) check.value = static_cast<double>(explained) / static_cast<double>(all);
  char text[512];
  if (!torn.empty()) {
    const bool is_bad = torn.size() > 1 && check.value < check.limit;
    check.level = is_bad ? CheckLevel::kBad : CheckLevel::kDoubtful;
    std::snprintf(text,
                  sizeof text,
                  "%zu of %zu verified pairs between images that follow one another contradict the "
                  "model, first %s: it is torn or folded onto itself there; compare the two "
                  "pictures, and take panoramas closer together or leave out what misleads",
                  torn.size(),
                  all,
                  NamesOf(results.manifest, torn.front()).c_str());
    check.sentence = text;
    return check;
  }
  const size_t run = LongestRun(far);
  if (run >= kRun) {
    check.level = CheckLevel::kDoubtful;
    std::snprintf(
        text,
        sizeof text,
        "%zu verified pairs contradict the model, up to %zu in a row, first %s: places "
        "that look alike, a second passage that was missed, or a model folded onto itself",
        far.size(),
        run,
        NamesOf(results.manifest, *far.begin()).c_str());
    check.sentence = text;
    return check;
  }
  std::snprintf(text,
                sizeof text,
                "the model explains all %zu verified pairs between images that follow one another; "
                "%zu pairs of others contradict it, one by one: places that look alike",
                all,
                judged.contradicted.size());
  check.sentence = text;
  return check;
}

}  // namespace orbweave
