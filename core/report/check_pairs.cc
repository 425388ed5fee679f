// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_pairs.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/report/steps_apart.h"
#include "core/scene/places_in_drives.h"

namespace orbweave {
namespace {

constexpr uint32_t kNeighbours = 2;  // places apart in a drive
constexpr size_t kRun = 3;
constexpr double kBadShare = 0.02;  // one in fifty, as in CheckSequenceSteps
// Places on either side of a pair, from which pairs lead across it.
constexpr uint32_t kFurther = 3;
constexpr size_t kFewestAcross = 2;
constexpr size_t kMajority = 2;

/// Of which images pairs are right, if they are not wrong in themselves.
class Neighbours {
 public:
  explicit Neighbours(const JobResults& results) : places_(results.manifest), apart_(results) {}

  [[nodiscard]] const PlacesInDrives& Places() const { return places_; }
  /// One after the other in their drive, or of two stretches, or passages, and beside each other in
  /// the model.
  [[nodiscard]] bool Are(const ImagePair& pair) const {
    if (AreOnOneWay(pair)) return places_.StepsBetween(pair) <= kNeighbours;
    const std::optional<double> steps = apart_.Between(pair);
    return steps && *steps <= kSeenWithin_steps;
  }
  /// Of one stretch and one passage.
  [[nodiscard]] bool AreOnOneWay(const ImagePair& pair) const {
    return places_.AreOfOneStretch(pair) && places_.StepsBetween(pair) <= kFurther;
  }

 private:
  PlacesInDrives places_;
  StepsApart apart_;
};

/// Pairs across a place of a drive, or from one stretch to another.
struct Across {
  size_t explained = 0;
  size_t contradicted = 0;

  /// Where the model is torn or folded the right pairs across are the contradicted ones.
  [[nodiscard]] bool BearOut() const {
    return explained >= kFewestAcross && explained > kMajority * contradicted;
  }
};

/// The image and those of its stretch before or after it in its drive, `kFurther` at most.
std::vector<ImageId> OnwardFrom(const PlacesInDrives& places, ImageId image, bool after) {
  std::vector<ImageId> images = {image};
  for (uint32_t i = 0; i < kFurther; ++i) {
    const std::optional<ImageId> next =
        after ? places.After(images.back()) : places.Before(images.back());
    if (!next || !places.AreOfOneStretch(MakePair(image, *next))) break;
    images.push_back(*next);
  }
  return images;
}

std::vector<ImageId> Around(const PlacesInDrives& places, ImageId image) {
  std::vector<ImageId> images = OnwardFrom(places, image, false);
  const std::vector<ImageId> after = OnwardFrom(places, image, true);
  images.insert(images.end(), after.begin() + 1, after.end());
  return images;
}

/// What the pairs say between these images and those.
Across PairsBetween(const PairsOfJob& judged,
                    const std::vector<ImageId>& these,
                    const std::vector<ImageId>& those) {
  std::set<ImagePair> pairs;
  for (const ImageId a : these) {
    for (const ImageId b : those) {
      if (a != b) pairs.insert(MakePair(a, b));
    }
  }
  Across across;
  for (const ImagePair& pair : pairs) {
    across.explained += judged.explained.contains(pair) ? 1 : 0;
    across.contradicted += judged.contradicted.contains(pair) ? 1 : 0;
  }
  return across;
}

/// What those say that lead across both images of a pair, itself among them.
Across PairsAcross(const PairsOfJob& judged, const Neighbours& neighbours, const ImagePair& pair) {
  const PlacesInDrives& places = neighbours.Places();
  if (!neighbours.AreOnOneWay(pair))
    return PairsBetween(judged, Around(places, pair.a), Around(places, pair.b));
  const bool is_late = places.PlaceOf(pair.b) < places.PlaceOf(pair.a);
  const ImageId first = is_late ? pair.b : pair.a;
  const ImageId last = is_late ? pair.a : pair.b;
  return PairsBetween(judged, OnwardFrom(places, first, false), OnwardFrom(places, last, true));
}

/// Pairs in rows: those of the images after theirs, or of the one after and the one before.
class Rows {
 public:
  Rows(const std::set<ImagePair>& pairs, const PlacesInDrives& places)
      : pairs_(pairs), places_(places) {}

  [[nodiscard]] size_t Longest() const {
    size_t longest = 0;
    for (const ImagePair& pair : pairs_) {
      for (const bool same_way : {true, false}) {
        const ImagePair first = InOrder(pair);
        if (!HasBefore(first, same_way)) longest = std::max(longest, LengthFrom(first, same_way));
      }
    }
    return longest;
  }

 private:
  /// Of one drive: the earlier image first.
  [[nodiscard]] ImagePair InOrder(const ImagePair& pair) const {
    const bool is_late =
        places_.AreOfOneDrive(pair) && places_.PlaceOf(pair.b) < places_.PlaceOf(pair.a);
    return is_late ? ImagePair{pair.b, pair.a} : pair;
  }
  /// Not where the two ends of a row have met.
  [[nodiscard]] bool Contains(std::optional<ImageId> a, std::optional<ImageId> b) const {
    if (!a || !b || *a == *b || InOrder({*a, *b}) != ImagePair{*a, *b}) return false;
    return pairs_.contains({std::min(*a, *b), std::max(*a, *b)});
  }
  [[nodiscard]] bool HasBefore(const ImagePair& pair, bool same_way) const {
    return Contains(places_.Before(pair.a),
                    same_way ? places_.Before(pair.b) : places_.After(pair.b));
  }
  [[nodiscard]] size_t LengthFrom(ImagePair pair, bool same_way) const {
    for (size_t length = 1;; ++length) {
      const std::optional<ImageId> a = places_.After(pair.a);
      const std::optional<ImageId> b = same_way ? places_.After(pair.b) : places_.Before(pair.b);
      if (!Contains(a, b)) return length;
      pair = {*a, *b};
    }
  }

  const std::set<ImagePair>& pairs_;
  const PlacesInDrives& places_;
};

std::string NamesOf(const ImageManifest& manifest, const ImagePair& pair) {
  return manifest.At(pair.a).name + " and " + manifest.At(pair.b).name;
}

}  // namespace

CrossCheck CheckPairs(const JobResults& results,
                      const PairsOfJob& judged,
                      const BorneOutByGnss& gnss) {
  const Neighbours neighbours(results);
  const auto are_neighbours = [&](const ImagePair& pair) { return neighbours.Are(pair); };
  const auto explained =
      static_cast<size_t>(std::ranges::count_if(judged.explained, are_neighbours));
  std::vector<ImagePair> torn;
  std::set<ImagePair> far;
  size_t outvoted = 0;
  for (const ImagePair& pair : judged.contradicted) {
    const bool is_of_neighbours = are_neighbours(pair);
    if (is_of_neighbours && !PairsAcross(judged, neighbours, pair).BearOut()) {
      torn.push_back(pair);
      continue;
    }
    outvoted += is_of_neighbours ? 1 : 0;
    if (!gnss.AreApart(pair)) {
      far.insert(pair);
    }
  }
  CrossCheck check{.name = "pairs_explained",
                   .value = 1.0,
                   .limit = 1.0,
                   .unit = "share",
                   .bound = CheckBound::kAtLeast};
  const size_t all = explained + torn.size();
  if (all > 0) check.value = static_cast<double>(explained) / static_cast<double>(all);
  char text[512];
  if (!torn.empty()) {
    const bool is_bad = torn.size() > 1 && check.value < 1.0 - kBadShare;
    check.level = is_bad ? CheckLevel::kBad : CheckLevel::kDoubtful;
    std::snprintf(text,
                  sizeof text,
                  "%zu of %zu verified pairs between neighbouring images contradict the "
                  "model, first %s: it is torn or folded onto itself there; compare the two "
                  "pictures, and take panoramas closer together or leave out what misleads",
                  torn.size(),
                  all,
                  NamesOf(results.manifest, torn.front()).c_str());
    check.sentence = text;
    return check;
  }
  const size_t run = Rows(far, neighbours.Places()).Longest();
  if (run >= kRun) {
    check.level = CheckLevel::kDoubtful;
    check.value = static_cast<double>(run);
    check.limit = static_cast<double>(kRun - 1);
    check.unit = "count";
    check.bound = CheckBound::kAtMost;
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
  check.sentence = absl::StrCat(
      "the model explains all ",
      all,
      " verified pairs between neighbouring images",
      outvoted > 0
          ? absl::StrCat(", but for ", outvoted, " that those across the same place outvote")
          : "",
      "; ",
      judged.contradicted.size() - outvoted,
      " pairs of others contradict it, one by one: places that look alike");
  return check;
}

}  // namespace orbweave
