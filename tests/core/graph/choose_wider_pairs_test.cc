// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/choose_wider_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "core/graph/list_pair_candidates.h"

namespace orbweave {
namespace {

using Pairs = std::vector<ImagePair>;

constexpr uint32_t kImages = 60;
const PairOptions kOptions{.first_neighbours = 4, .thin_below = 3};

/// A drive of images 3 m apart that turns after half of them and comes back.
ImageManifest ThereAndBack() {
  ImageManifest manifest;
  for (uint32_t i = 0; i < kImages; ++i) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(i);
    image.prior.position_in_enu = Eigen::Vector3d(3.0 * std::min(i, kImages - 1 - i), 0.0, 0.0);
  }
  return manifest;
}

MatchedPair Strong(const ImagePair& pair) {
  return {.pair = pair,
          .kind = TwoViewKind::kGeneral,
          .num_moved = 300,
          .log10_false_alarms = -400.0,
          .b_from_a = {Eigen::Quaterniond::Identity(), -Eigen::Vector3d::UnitX()}};
}

bool IsOfSequence(const ImagePair& pair) { return pair.b.value - pair.a.value <= 10; }

bool Has(const Pairs& pairs, uint32_t a, uint32_t b) {
  return std::ranges::binary_search(pairs, MakePair(ImageId(a), ImageId(b)));
}

/// What is found of pairs, where `find` says it.
std::vector<MatchedPair> Match(const Pairs& pairs,
                               const std::function<MatchedPair(const ImagePair&)>& find) {
  std::vector<MatchedPair> matched;
  for (const ImagePair& pair : pairs) {
    const MatchedPair found = find(pair);
    if (found.kind != TwoViewKind::kNone) matched.push_back(found);
  }
  return matched;
}

struct Street {
  ImageManifest manifest = ThereAndBack();
  PairCandidates candidates = ListPairCandidates(manifest, {}, 10, kOptions);

  [[nodiscard]] WiderPairs Choose(const std::vector<MatchedPair>& matched,
                                  const WiderPairs& before = {}) const {
    return ChooseWiderPairs(manifest, candidates, matched, before, kOptions);
  }
  [[nodiscard]] uint32_t CountOfSequence(const Pairs& pairs, uint32_t image) const {
    return static_cast<uint32_t>(std::ranges::count_if(pairs, [&](const ImagePair& pair) {
      return IsOfSequence(pair) && (pair.a.value == image || pair.b.value == image);
    }));
  }
};

TEST(ChooseWiderPairs, HoldsBackMostOfAStrongChain) {
  const Street street;
  const WiderPairs wider = street.Choose(Match(street.candidates.first, Strong));
  EXPECT_EQ(wider.decisions, 1U);
  EXPECT_GT(wider.num_held_back, street.candidates.second.size() / 3);
  EXPECT_EQ(wider.num_held_back + wider.second.size(), street.candidates.second.size());
  EXPECT_LE(street.CountOfSequence(wider.second, 15), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(wider.second));
}

/// A spanner: two pairs lead to every image within the window.
TEST(ChooseWiderPairs, LeavesTwoPairsBetweenAnyTwoOfAWindow) {
  const Street street;
  const WiderPairs wider = street.Choose(Match(street.candidates.first, Strong));
  Pairs kept;
  std::ranges::merge(street.candidates.first, wider.second, std::back_inserter(kept));
  for (uint32_t a = 0; a < kImages; ++a) {
    for (uint32_t b = a + 1; b < kImages && b <= a + 10; ++b) {
      bool is_near = Has(kept, a, b);
      for (uint32_t m = 0; m < kImages && !is_near; ++m)
        is_near = m != a && m != b && Has(kept, a, m) && Has(kept, m, b);
      EXPECT_TRUE(is_near) << a << " " << b;
    }
  }
}

TEST(ChooseWiderPairs, MatchesPairsBetweenTwoPasses) {
  const Street street;
  const WiderPairs wider = street.Choose(Match(street.candidates.first, Strong));
  for (const ImagePair& pair : street.candidates.second) {
    if (!IsOfSequence(pair)) {
      EXPECT_TRUE(Has(wider.second, pair.a.value, pair.b.value));
    }
  }
}

TEST(ChooseWiderPairs, MatchesPairsOfTwoDrives) {
  Street street;
  for (uint32_t i = 30; i < kImages; ++i) street.manifest.images[i].drive = 1;
  const WiderPairs wider = street.Choose(Match(street.candidates.first, Strong));
  for (const ImagePair& pair : street.candidates.second) {
    if (pair.a.value < 30 && pair.b.value >= 30) {
      EXPECT_TRUE(Has(wider.second, pair.a.value, pair.b.value));
    }
  }
}

/// What is found of pairs that lead from below image 20 to above.
class WeakPlace : public ::testing::TestWithParam<MatchedPair> {};

TEST_P(WeakPlace, IsMatchedAsBefore) {
  const Street street;
  const auto crosses = [](const ImagePair& pair) {
    return IsOfSequence(pair) && pair.a.value < 20 && pair.b.value >= 20;
  };
  const WiderPairs wider = street.Choose(Match(street.candidates.first, [&](const ImagePair& pair) {
    MatchedPair found = Strong(pair);
    // The other pass must not lead around it.
    if (crosses(pair) || !IsOfSequence(pair)) {
      found = GetParam();
      found.pair = pair;
    }
    return found;
  }));
  for (const ImagePair& pair : street.candidates.second) {
    if (crosses(pair)) {
      EXPECT_TRUE(Has(wider.second, pair.a.value, pair.b.value));
    }
  }
  EXPECT_GT(wider.num_held_back, 50U) << "elsewhere";
}

INSTANTIATE_TEST_SUITE_P(
    WhereTheChain,
    WeakPlace,
    ::testing::Values(MatchedPair{},                                            // is broken
                      MatchedPair{{}, TwoViewKind::kGeneral, 300, -119.0},      // may be chance
                      MatchedPair{{}, TwoViewKind::kGeneral, 20, -400.0},       // hardly moves
                      MatchedPair{{}, TwoViewKind::kPureRotation, 300, -400.0}  // stands
                      ));

TEST(ChooseWiderPairs, MatchesAllWhereNothingWasFound) {
  const Street street;
  const WiderPairs wider = street.Choose({});
  EXPECT_EQ(wider.second, street.candidates.second);
  EXPECT_EQ(wider.num_held_back, 0U);
  EXPECT_TRUE(wider.reserve.empty()) << "before the others are matched";
}

TEST(ChooseWiderPairs, DoesNotCareInWhichOrderPairsWereFound) {
  const Street street;
  std::vector<MatchedPair> matched = Match(street.candidates.first, [](const ImagePair& pair) {
    MatchedPair found = Strong(pair);
    if (pair.a.value % 7 == 0) found.log10_false_alarms = -20.0;
    return found;
  });
  const WiderPairs wider = street.Choose(matched);
  std::mt19937 random(7);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(matched.begin(), matched.end(), random);
    const WiderPairs again = street.Choose(matched);
    EXPECT_EQ(again.second, wider.second);
    EXPECT_EQ(again.num_held_back, wider.num_held_back);
  }
}

/// All that is asked for is matched until nothing more is.
WiderPairs ChooseToTheEnd(const Street& street,
                          const std::function<MatchedPair(const ImagePair&)>& find) {
  WiderPairs wider;
  for (int round = 0; round < 4; ++round) {
    Pairs pairs = street.candidates.first;
    pairs.insert(pairs.end(), wider.second.begin(), wider.second.end());
    pairs.insert(pairs.end(), wider.reserve.begin(), wider.reserve.end());
    wider = street.Choose(Match(pairs, find), wider);
  }
  return wider;
}

TEST(ChooseWiderPairs, HoldsNothingBackForPairsThatPredictionsMadeEvident) {
  const Street street;
  const auto by_predictions = [](const ImagePair& pair) {
    MatchedPair matched = Strong(pair);
    matched.rung = MatchRung::kGuided;
    return matched;
  };
  const WiderPairs wider = street.Choose(Match(street.candidates.first, by_predictions));
  EXPECT_EQ(wider.num_held_back, 0U);
  EXPECT_EQ(wider.second, street.candidates.second);
}

TEST(ChooseWiderPairs, SpeaksOfNoThinImagesWhereThereIsNothingElseToTry) {
  Street street;
  street.candidates.second.clear();
  street.candidates.reserve.clear();
  EXPECT_EQ(street.Choose({}).num_thin_images, 0U);
}

TEST(ChooseWiderPairs, OpensTheReserveOfThinImagesAlone) {
  const Street street;
  const auto joins_few = [](const ImagePair& pair) {
    const bool is_thin = pair.a.value == 12 || pair.b.value == 12;
    const bool is_one_of_two = pair.b.value - pair.a.value == 1;
    return is_thin && !is_one_of_two ? MatchedPair{} : Strong(pair);
  };
  const WiderPairs wider = ChooseToTheEnd(street, joins_few);
  EXPECT_EQ(wider.num_thin_images, 1U);
  EXPECT_TRUE(Has(wider.reserve, 12, 12 + 15));
  EXPECT_TRUE(Has(wider.reserve, 12, 12 + 5));  // held back at first
  const uint32_t without_thin = ChooseToTheEnd(street, Strong).num_held_back;
  EXPECT_LT(wider.num_held_back, without_thin);
  for (const ImagePair& pair : wider.reserve) EXPECT_TRUE(pair.a.value == 12 || pair.b.value == 12);
  EXPECT_LE(wider.reserve.size(), 100U);
  EXPECT_TRUE(ChooseToTheEnd(street, Strong).reserve.empty());
}

TEST(ChooseWiderPairs, OpensTheReserveOfSmallParts) {
  const Street street;
  const auto falls_apart = [](const ImagePair& pair) {
    return (pair.a.value < 10) == (pair.b.value < 10) ? Strong(pair) : MatchedPair{};
  };
  const WiderPairs wider = ChooseToTheEnd(street, falls_apart);
  EXPECT_EQ(wider.num_thin_images, 10U);
  EXPECT_TRUE(Has(wider.reserve, 9, 9 + 20));
  EXPECT_FALSE(Has(wider.reserve, 20, 20 + 20));
}

/// Neighbours are joined, and a chain over the one between them predicts what is further apart.
TEST(ChooseWiderPairs, MatchesAgainWhatOthersPredict) {
  Street street;
  const auto joins_neighbours = [](const ImagePair& pair) {
    return pair.b.value - pair.a.value == 1 ? Strong(pair) : MatchedPair{};
  };
  const WiderPairs wider = ChooseToTheEnd(street, joins_neighbours);
  EXPECT_EQ(wider.decisions, 3U);
  ASSERT_EQ(wider.predicted.size(), kImages - 2);
  for (const PredictedPair& predicted : wider.predicted) {
    EXPECT_EQ(predicted.pair.b.value - predicted.pair.a.value, 2U);
    EXPECT_TRUE(predicted.pose.AgreesWith(Strong(predicted.pair).b_from_a));
  }
  EXPECT_EQ(street.Choose({}, wider).predicted.size(), wider.predicted.size()) << "decided once";
  PairOptions options = kOptions;
  options.predict = false;
  WiderPairs without{.decisions = 2, .second = wider.second, .reserve = wider.reserve};
  without = ChooseWiderPairs(street.manifest,
                             street.candidates,
                             Match(street.candidates.first, joins_neighbours),
                             without,
                             options);
  EXPECT_TRUE(without.predicted.empty());
}

TEST(ChooseWiderPairs, DecidesOnce) {
  const Street street;
  const WiderPairs wider = ChooseToTheEnd(street, [](const ImagePair&) { return MatchedPair{}; });
  EXPECT_EQ(wider.second, street.candidates.second);
  EXPECT_EQ(wider.reserve, street.candidates.reserve);
  const WiderPairs again = street.Choose({}, wider);
  EXPECT_EQ(again.second, wider.second);
  EXPECT_EQ(again.reserve, wider.reserve);
  EXPECT_EQ(again.num_thin_images, wider.num_thin_images);
}

TEST(ChooseWiderPairs, AsksForNothingWhereThereIsNothing) {
  const WiderPairs wider = ChooseWiderPairs({}, {}, {}, {}, kOptions);
  EXPECT_EQ(wider.decisions, 3U);
  EXPECT_TRUE(wider.second.empty());
  EXPECT_TRUE(wider.reserve.empty());
}

}  // namespace
}  // namespace orbweave
