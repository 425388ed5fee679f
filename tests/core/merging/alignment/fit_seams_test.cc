// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/fit_seams.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/merging/boundary_tracks.h"
#include "proto/codec/seams_codec.h"
#include "tests/core/merging/split_world.h"

namespace orbweave {
namespace {

using testing::SplitWorld;

SplitWorld StraightWorld() {
  Random random(3);
  Reconstruction street = testing::MakeStreet(testing::StraightLine(62, 2.0), random);
  return testing::Split(std::move(street), 5, 10, 22, 0.005, random);
}

SeamsOfCluster Fit(std::span<const Submodel> own, std::span<const Submodel> later, int threads) {
  auto seams = FitSeams(own, later, 8.0, {.num_threads = threads});
  EXPECT_TRUE(seams.ok()) << seams.status();
  return std::move(seams).value_or(SeamsOfCluster{});
}

TEST(FitSeams, FindsThoseWithACommonImageOnce) {
  const SplitWorld world = StraightWorld();
  const std::span<const Submodel> all = world.submodels;
  std::vector<std::pair<uint32_t, uint32_t>> found;
  for (size_t m = 0; m < all.size(); ++m) {
    const SeamsOfCluster seams = Fit(all.subspan(m, 1), all.subspan(m + 1), 1);
    ASSERT_EQ(seams.submodels.size(), 1U);
    EXPECT_EQ(seams.submodels[0].name, all[m].name());
    EXPECT_EQ(seams.submodels[0].images.size(), all[m].reconstruction.images.size());
    for (const FittedSeam& seam : seams.seams) found.emplace_back(seam.a.cluster, seam.b.cluster);
  }
  const std::vector<std::pair<uint32_t, uint32_t>> expected{
      {0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}, {2, 4}, {3, 4}};
  EXPECT_EQ(found, expected);
}

TEST(FitSeams, NeedsNoMoreThanRims) {
  const SplitWorld world = StraightWorld();
  std::vector<Submodel> boundaries = world.submodels;
  for (Submodel& boundary : boundaries) {
    std::vector<ImageId> shared;
    for (const auto& [id, image] : boundary.reconstruction.images) {
      for (const Submodel& other : world.submodels) {
        if (other.cluster == boundary.cluster || !other.reconstruction.images.contains(id))
          continue;
        shared.push_back(id);
        break;
      }
    }
    boundary.reconstruction = BoundaryTracksOf(boundary.reconstruction, shared);
  }
  const std::span<const Submodel> whole = world.submodels;
  const std::span<const Submodel> part = boundaries;
  for (size_t m = 0; m < boundaries.size(); ++m) {
    EXPECT_EQ(EncodeSeamsOfCluster(Fit(whole.subspan(m, 1), whole.subspan(m + 1), 1)).value(),
              EncodeSeamsOfCluster(Fit(part.subspan(m, 1), part.subspan(m + 1), 1)).value());
  }
}

TEST(FitSeams, GivesTheSameBytesForAnyNumberOfThreads) {
  const SplitWorld world = StraightWorld();
  const std::span<const Submodel> all = world.submodels;
  EXPECT_EQ(EncodeSeamsOfCluster(Fit(all.first(1), all.subspan(1), 1)).value(),
            EncodeSeamsOfCluster(Fit(all.first(1), all.subspan(1), 3)).value());
}

TEST(FitSeams, AllowsClustersOfWhichNothingIsLeft) {
  EXPECT_TRUE(Fit({}, {}, 1).submodels.empty());
  const std::vector<Submodel> empty(1);
  EXPECT_EQ(Fit(empty, {}, 1).submodels.size(), 1U);
  EXPECT_TRUE(Fit(empty, {}, 1).seams.empty());
}

TEST(SeamsCodec, GivesBackWhatItTook) {
  const SplitWorld world = StraightWorld();
  const std::span<const Submodel> all = world.submodels;
  const std::string bytes = EncodeSeamsOfCluster(Fit(all.first(2), all.subspan(2), 1)).value();
  const auto decoded = DecodeSeamsOfCluster(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(EncodeSeamsOfCluster(*decoded).value(), bytes);
}

TEST(SeamsCodec, RefusesWhatIsCutOff) {
  const SplitWorld world = StraightWorld();
  const std::span<const Submodel> all = world.submodels;
  const std::string bytes = EncodeSeamsOfCluster(Fit(all.first(2), all.subspan(2), 1)).value();
  for (size_t size = 1; size + 1 < bytes.size(); size += 97) {
    const auto decoded = DecodeSeamsOfCluster(std::string_view(bytes).substr(0, size));
    if (!decoded.ok()) continue;
    EXPECT_LT(EncodeSeamsOfCluster(*decoded).value().size(), bytes.size()) << size;
  }
}

}  // namespace
}  // namespace orbweave
