// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/dense_codec.h"

#include <gtest/gtest.h>

#include "proto/codec/dense_bulk_codec.h"
#include "tests/support/dense_values.h"

namespace orbweave {
namespace {

using namespace testing;

/// Bytes that decode are those that the decoded value has again; cut ones and such without a tail
/// are refused or another value, never a crash.
template <typename Encode, typename Decode, typename T>
void ExpectRoundTrip(const Encode& encode, const Decode& decode, const T& value) {
  const std::string bytes = encode(value).value();
  const auto decoded = decode(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(encode(*decoded).value(), bytes);
  for (size_t size = 0; size < bytes.size(); ++size)
    (void)decode(std::string_view(bytes).substr(0, size));
}

TEST(DenseCodec, RoundTripsWhatStagesHandOn) {
  ExpectRoundTrip(EncodeViewRecipe, DecodeViewRecipe, SomeViewRecipe());
  ExpectRoundTrip(EncodeChosenSources, DecodeChosenSources, SomeChosenSources());
  ExpectRoundTrip(EncodeDepthRecipe, DecodeDepthRecipe, SomeDepthRecipe());
  ExpectRoundTrip(EncodeDensePlan, DecodeDensePlan, SomeDensePlan());
  ExpectRoundTrip(EncodeCheckRecipe, DecodeCheckRecipe, SomeCheckRecipe());
  ExpectRoundTrip(EncodeFuseRecipe, DecodeFuseRecipe, SomeFuseRecipe());
  ExpectRoundTrip(EncodeTileRuns, DecodeTileRuns, SomeTileRuns());
  ExpectRoundTrip(EncodeTileRecipe, DecodeTileRecipe, SomeTileRecipe());
  ExpectRoundTrip(EncodeDepthMap, DecodeDepthMap, SomeDepthMap());
  ExpectRoundTrip(EncodeSurfacePoints, DecodeSurfacePoints, SomeSurfacePoints());
  ExpectRoundTrip(EncodeDenseTile, DecodeDenseTile, SomeDenseTile());
}

TEST(DenseCodec, KeepsEveryField) {
  const DepthRecipe recipe =
      DecodeDepthRecipe(EncodeDepthRecipe(SomeDepthRecipe()).value()).value();
  EXPECT_EQ(recipe.reference.content, DigestOf("image"));
  EXPECT_EQ(recipe.reference.mask, DigestOf("mask"));
  EXPECT_EQ(recipe.reference.camera, (EquirectangularCamera{2048, 1024}));
  ASSERT_EQ(recipe.sources.size(), 1U);
  EXPECT_EQ(recipe.sources[0].source_from_reference.translation, SomePose().translation);
  ASSERT_EQ(recipe.seeds.size(), 1U);
  EXPECT_EQ(recipe.seeds[0].bearing, SomeSeeds()[0].bearing);
  EXPECT_EQ(recipe.seeds[0].sigma_m, 0.25);
  EXPECT_EQ(recipe.max_range, 16.0);
  const PlacedMap map = DecodeFuseRecipe(EncodeFuseRecipe(SomeFuseRecipe()).value())->neighbours[0];
  EXPECT_EQ(map.image, ImageId(4));
  EXPECT_EQ(map.unit_m, 2.5);
  EXPECT_EQ(map.reach_m, 12.0);
  const DensePlan plan = DecodeDensePlan(EncodeDensePlan(SomeDensePlan()).value()).value();
  EXPECT_EQ(plan.omitted[0].reason, "it is in no model");
  EXPECT_EQ(plan.panoramas[0].sources, std::vector{ImageId(4)});
  EXPECT_EQ(DecodeDenseTile(EncodeDenseTile(SomeDenseTile()).value())->points, SomeSurfacePoints());
}

TEST(DepthMapCodec, KeepsPixelsWithARangeAndNothingElse) {
  const DepthMap in = SomeDepthMap();
  const DepthMap out = DecodeDepthMap(EncodeDepthMap(in).value()).value();
  EXPECT_EQ(out.face_px, in.face_px);
  EXPECT_EQ(out.range_m, in.range_m);
  EXPECT_EQ(out.normals, in.normals);
  EXPECT_EQ(out.sigma_m, in.sigma_m);
  EXPECT_EQ(out.views, in.views);
  EXPECT_EQ(out.flags, in.flags);
  EXPECT_EQ(out.problem, in.problem);
  const DepthMap empty = DecodeDepthMap(EncodeDepthMap({.problem = "why"}).value()).value();
  EXPECT_EQ(empty.size(), 0U);
  EXPECT_EQ(empty.problem, "why");
}

TEST(DenseCodec, RefusesWhatIsNone) {
  DepthMap map = SomeDepthMap();
  map.sigma_m[1] = -1.0F;
  EXPECT_FALSE(DecodeDepthMap(EncodeDepthMap(map).value()).ok());
  map = SomeDepthMap();
  map.face_px = 3;
  EXPECT_FALSE(DecodeDepthMap(EncodeDepthMap(map).value()).ok());
  DepthRecipe recipe = SomeDepthRecipe();
  recipe.seeds[0].bearing *= 2.0;
  EXPECT_FALSE(DecodeDepthRecipe(EncodeDepthRecipe(recipe).value()).ok());
  recipe = SomeDepthRecipe();
  recipe.max_range = recipe.min_range;
  EXPECT_FALSE(DecodeDepthRecipe(EncodeDepthRecipe(recipe).value()).ok());
  CheckRecipe check = SomeCheckRecipe();
  check.own.unit_m = std::nan("");
  EXPECT_FALSE(DecodeCheckRecipe(EncodeCheckRecipe(check).value()).ok());
  SurfacePoints points = SomeSurfacePoints();
  points[0].position_in_world.x() = HUGE_VAL;
  EXPECT_FALSE(DecodeSurfacePoints(EncodeSurfacePoints(points).value()).ok());
}

}  // namespace
}  // namespace orbweave
