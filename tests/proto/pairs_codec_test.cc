// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/pairs_codec.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "proto/codec/carrier_codec.h"

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

TEST(CarrierCodec, KeepsCarriersAndRefusesWhatIsNone) {
  const std::vector<Carrier> in = {{.images = {ImageId(0), ImageId(3)}, .cells = {7, 4095}},
                                   {.images = {ImageId(9)}, .cells = {0}}};
  const auto out = DecodeCarriers(EncodeCarriers(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  EXPECT_EQ(*out, in);
  for (const Carrier& wrong : {Carrier{.cells = {kNumCarrierCells}},
                               Carrier{.cells = {7, 7}},
                               Carrier{.images = {ImageId(3), ImageId(0)}}})
    EXPECT_TRUE(absl::IsDataLoss(DecodeCarriers(EncodeCarriers({wrong}).value()).status()));
}

const Rigid3 kPose = {Eigen::Quaterniond(0.6, 0.0, 0.8, 0.0), {0.0, 0.6, 0.8}};

MatchedPair Found(const ImagePair& pair, TwoViewKind kind, double evidence, const Rigid3& pose) {
  return {.pair = pair,
          .kind = kind,
          .num_moved = 81,
          .log10_false_alarms = evidence,
          .rung = MatchRung::kPropagated,
          .b_from_a = pose};
}

TEST(PairsCodec, KeepsWhatIsKnownOfPairs) {
  const std::vector<MatchedPair> in = {Found(kSome[0], TwoViewKind::kPureRotation, -7.25, {}),
                                       Found(kSome[1], TwoViewKind::kPlanar, -812.5, kPose)};
  const auto out = DecodeMatchedPairs(EncodeMatchedPairs(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  ASSERT_EQ(out->size(), in.size());
  for (size_t i = 0; i < in.size(); ++i) {
    EXPECT_EQ((*out)[i].pair, in[i].pair);
    EXPECT_EQ((*out)[i].kind, in[i].kind);
    EXPECT_EQ((*out)[i].num_moved, in[i].num_moved);
    EXPECT_EQ((*out)[i].log10_false_alarms, in[i].log10_false_alarms);
    EXPECT_EQ((*out)[i].rung, in[i].rung);
    EXPECT_EQ((*out)[i].b_from_a.rotation.coeffs(), in[i].b_from_a.rotation.coeffs());
    EXPECT_EQ((*out)[i].b_from_a.translation, in[i].b_from_a.translation);
  }
  EXPECT_TRUE(DecodeMatchedPairs(EncodeMatchedPairs({}).value())->empty());
}

const PredictedPose kPredicted = {kPose.rotation, {0.6, 0.0, 0.8}, {0.0, 1.0, 0.0}};

TEST(PairsCodec, KeepsWhatWasDecided) {
  const WiderPairs in{.wants_facades = true,
                      .decisions = 2,
                      .second = kOthers,
                      .reserve = kSome,
                      .predicted = {{kOthers[0], kPredicted}},
                      .num_held_back = 5,
                      .num_thin_images = 7};
  const auto out = DecodeWiderPairs(EncodeWiderPairs(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  EXPECT_TRUE(out->wants_facades);
  EXPECT_EQ(out->decisions, 2U);
  EXPECT_EQ(out->second, in.second);
  EXPECT_EQ(out->reserve, in.reserve);
  ASSERT_EQ(out->predicted.size(), 1U);
  EXPECT_EQ(out->predicted[0].pair, kOthers[0]);
  EXPECT_EQ(out->predicted[0].pose.rotation.coeffs(), kPredicted.rotation.coeffs());
  EXPECT_EQ(out->predicted[0].pose.first, kPredicted.first);
  EXPECT_EQ(out->predicted[0].pose.last, kPredicted.last);
  EXPECT_EQ(out->num_held_back, 5U);
  EXPECT_EQ(out->num_thin_images, 7U);
}

TEST(PairsCodec, RefusesPairsOutOfOrderAndEvidenceThatIsNone) {
  EXPECT_TRUE(absl::IsDataLoss(
      DecodePairCandidates(EncodePairCandidates({.second = kTurned}).value()).status()));
  EXPECT_TRUE(absl::IsDataLoss(
      DecodeWiderPairs(EncodeWiderPairs({.reserve = {kSome[1], kSome[0]}}).value()).status()));
  const auto refuses = [](const MatchedPair& pair) {
    return absl::IsDataLoss(DecodeMatchedPairs(EncodeMatchedPairs({pair}).value()).status());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refuses(Found(kSome[0], TwoViewKind::kGeneral, nan, kPose)));
  EXPECT_TRUE(refuses(Found(kSome[0], static_cast<TwoViewKind>(9), -5.0, kPose)));
}

TEST(PairsCodec, RefusesPosesThatLeadNowhere) {
  const auto refuses = [](const MatchedPair& pair) {
    return absl::IsDataLoss(DecodeMatchedPairs(EncodeMatchedPairs({pair}).value()).status());
  };
  EXPECT_TRUE(refuses(Found(kSome[0], TwoViewKind::kGeneral, -9.0, {})));
  EXPECT_TRUE(refuses(Found(kSome[0], TwoViewKind::kGeneral, -9.0, {{2, 0, 0, 0}, {1, 0, 0}})));
  EXPECT_FALSE(refuses(Found(kSome[0], TwoViewKind::kGeneral, -9.0, kPose)));
  PredictedPose nowhere = kPredicted;
  nowhere.last.setZero();
  EXPECT_TRUE(absl::IsDataLoss(
      DecodeWiderPairs(EncodeWiderPairs({.predicted = {{kSome[0], nowhere}}}).value()).status()));
}

}  // namespace
}  // namespace orbweave
