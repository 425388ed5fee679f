// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/pairs_codec.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace orbweave {
namespace {

const std::vector<ImagePair> kSome = {{ImageId(0), ImageId(3)}, {ImageId(1), ImageId(2)}};
const std::vector<ImagePair> kOthers = {{ImageId(0), ImageId(9)}};
const std::vector<ImagePair> kTurned = {{ImageId(3), ImageId(0)}};

TEST(PairsCodec, KeepsEveryListOfCandidates) {
  const PairCandidates in{.first = kSome, .second = kOthers};
  const auto out = DecodePairCandidates(EncodePairCandidates(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  EXPECT_EQ(out->first, in.first);
  EXPECT_EQ(out->second, in.second);
  EXPECT_TRUE(out->reserve.empty());
}

TEST(PairsCodec, KeepsWhatIsKnownOfPairs) {
  const std::vector<MatchedPair> in = {{kSome[0], TwoViewKind::kPureRotation, 0, -7.25},
                                       {kSome[1], TwoViewKind::kPlanar, 81, -812.5}};
  const auto out = DecodeMatchedPairs(EncodeMatchedPairs(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  EXPECT_EQ(*out, in);
  EXPECT_TRUE(DecodeMatchedPairs(EncodeMatchedPairs({}).value())->empty());
}

TEST(PairsCodec, KeepsWhatWasDecided) {
  const WiderPairs in{.decisions = 2,
                      .second = kOthers,
                      .reserve = kSome,
                      .num_held_back = 5,
                      .num_thin_images = 7};
  const auto out = DecodeWiderPairs(EncodeWiderPairs(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  EXPECT_EQ(out->decisions, 2U);
  EXPECT_EQ(out->second, in.second);
  EXPECT_EQ(out->reserve, in.reserve);
  EXPECT_EQ(out->num_held_back, 5U);
  EXPECT_EQ(out->num_thin_images, 7U);
}

TEST(PairsCodec, RefusesPairsOutOfOrderAndEvidenceThatIsNone) {
  EXPECT_TRUE(absl::IsDataLoss(
      DecodePairCandidates(EncodePairCandidates({.second = kTurned}).value()).status()));
  EXPECT_TRUE(absl::IsDataLoss(
      DecodeWiderPairs(EncodeWiderPairs({.reserve = {kSome[1], kSome[0]}}).value()).status()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(absl::IsDataLoss(
      DecodeMatchedPairs(EncodeMatchedPairs({{kSome[0], TwoViewKind::kGeneral, 1, nan}}).value())
          .status()));
  EXPECT_TRUE(absl::IsDataLoss(
      DecodeMatchedPairs(
          EncodeMatchedPairs({{kSome[0], static_cast<TwoViewKind>(9), 1, -5.0}}).value())
          .status()));
}

}  // namespace
}  // namespace orbweave
