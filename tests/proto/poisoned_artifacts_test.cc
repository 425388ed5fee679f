// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Whoever reads what a worker left may count on its numbers. Every number of every artifact is
// replaced in turn by what no encoder writes: its decoder refuses that, or takes it for something
// that means the same ever after.

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "orbweave/v1/adjustment.pb.h"
#include "orbweave/v1/artifacts.pb.h"
#include "orbweave/v1/dense.pb.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/carrier_codec.h"
#include "proto/codec/dense_bulk_codec.h"
#include "proto/codec/dense_codec.h"
#include "proto/codec/features_codec.h"
#include "proto/codec/inspection_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/pairs_codec.h"
#include "proto/codec/recipes_codec.h"
#include "proto/codec/reconstruction_codec.h"
#include "proto/codec/seams_codec.h"
#include "proto/codec/subproblem_codec.h"
#include "proto/codec/two_view_codec.h"
#include "tests/fuzz/seeds.h"
#include "tests/support/poison_message.h"

namespace orbweave {
namespace {

using testing::Message;
using testing::MessagePoisoner;

/// Numbers that may be what nobody can compute with, and why.
const std::set<std::string> kMayBeAnything = {
    "GeodeticPosition.altitude_m",     // not a number: nobody knows it
    "Biases.sigmas_m",                 // infinite: another subproblem counts the bias
    "FittedSeam.condition_number",     // infinite: the seam is singular
    "SeamReport.condition_number",     // the same
    "Georeference.scale_uncertainty",  // of a model without extent, which has no place
    "TrialCost.cost",                  // of a step that led nowhere and is not taken
    "TrialCost.predicted_decrease",    // the same
    "TrialCost.retained_before",       // the same
    "TrialCost.retained_after",        // the same
};

/// Nothing where bytes are refused; else what the decoder took, encoded again, which must be taken
/// too and mean the same.
using Reencode = std::function<std::string(const std::string& bytes)>;

template <typename Decode, typename Encode>
Reencode RoundTripBy(Decode decode, Encode encode) {
  return [decode, encode](const std::string& bytes) -> std::string {
    const auto value = decode(bytes);
    if (!value.ok()) return "";
    const std::string again = encode(*value).value();
    const auto same = decode(again);
    EXPECT_TRUE(same.ok()) << same.status();
    EXPECT_EQ(same.ok() ? encode(*same).value() : "", again);
    return again;
  };
}

struct Artifact {
  std::shared_ptr<Message> message{};
  Reencode reencode{};
};

template <typename Proto, typename Decode, typename Encode>
Artifact ArtifactOf(Decode decode, Encode encode) {
  return {std::make_shared<Proto>(), RoundTripBy(decode, encode)};
}

/// By name of the seed.
std::map<std::string, Artifact> Artifacts() {
  return {
      {"features", ArtifactOf<v1::Features>(DecodeFeatures, EncodeFeatures)},
      {"place_sample", ArtifactOf<v1::PlaceSample>(DecodePlaceSample, EncodePlaceSample)},
      {"image_sources", ArtifactOf<v1::ImageSources>(DecodeImageSources, EncodeImageSources)},
      {"image_manifest", ArtifactOf<v1::ImageManifest>(DecodeImageManifest, EncodeImageManifest)},
      {"two_view_geometries",
       ArtifactOf<v1::TwoViewGeometries>(DecodeTwoViewGeometries, EncodeTwoViewGeometries)},
      {"divided_view_graph",
       ArtifactOf<v1::Partition>(DecodeDividedViewGraph, EncodeDividedViewGraph)},
      {"pair_candidates",
       ArtifactOf<v1::PairCandidates>(DecodePairCandidates, EncodePairCandidates)},
      {"carriers", ArtifactOf<v1::Carriers>(DecodeCarriers, EncodeCarriers)},
      {"matched_pairs", ArtifactOf<v1::MatchedPairs>(DecodeMatchedPairs, EncodeMatchedPairs)},
      {"wider_pairs", ArtifactOf<v1::WiderPairs>(DecodeWiderPairs, EncodeWiderPairs)},
      {"match_recipe", ArtifactOf<v1::MatchRecipe>(DecodeMatchRecipe, EncodeMatchRecipe)},
      {"cluster_recipe", ArtifactOf<v1::ClusterRecipe>(DecodeClusterRecipe, EncodeClusterRecipe)},
      {"reconstruction",
       ArtifactOf<v1::Reconstruction>(DecodeReconstruction, EncodeReconstruction)},
      {"cluster_result",
       ArtifactOf<v1::ClusterReconstruction>(DecodeClusterResult, EncodeClusterResult)},
      {"alignment", ArtifactOf<v1::Alignment>(DecodeAlignment, EncodeAlignment)},
      {"partition_review",
       ArtifactOf<v1::PartitionReview>(DecodePartitionReview, EncodePartitionReview)},
      {"seams_of_cluster",
       ArtifactOf<v1::SeamsOfCluster>(DecodeSeamsOfCluster, EncodeSeamsOfCluster)},
      {"world_block", ArtifactOf<v1::Subproblem>(DecodeSubproblem, EncodeSubproblem)},
      {"assemble_recipe",
       ArtifactOf<v1::AssembleRecipe>(DecodeAssembleRecipe, EncodeAssembleRecipe)},
      {"joined_worlds", ArtifactOf<v1::JoinedWorlds>(DecodeJoinedWorlds, EncodeJoinedWorlds)},
      {"block_state",
       ArtifactOf<v1::SubproblemState>(DecodeSubproblemState, EncodeSubproblemState)},
      {"block_task", ArtifactOf<v1::SubproblemTask>(DecodeSubproblemTask, EncodeSubproblemTask)},
      {"block_result",
       ArtifactOf<v1::SubproblemResult>(DecodeSubproblemResult, EncodeSubproblemResult)},
      {"block_inspection",
       ArtifactOf<v1::SubproblemInspection>(DecodeSubproblemInspection,
                                            EncodeSubproblemInspection)},
      {"adjustment_progress",
       ArtifactOf<v1::AdjustmentProgress>(DecodeAdjustmentProgress, EncodeAdjustmentProgress)},
      {"concluded_model",
       ArtifactOf<v1::FinalisedModel>(DecodeFinalisedModel, EncodeFinalisedModel)},
      {"view_recipe", ArtifactOf<v1::ViewRecipe>(DecodeViewRecipe, EncodeViewRecipe)},
      {"chosen_sources", ArtifactOf<v1::ChosenSources>(DecodeChosenSources, EncodeChosenSources)},
      {"depth_recipe", ArtifactOf<v1::DepthRecipe>(DecodeDepthRecipe, EncodeDepthRecipe)},
      {"dense_plan", ArtifactOf<v1::DensePlan>(DecodeDensePlan, EncodeDensePlan)},
      {"check_recipe", ArtifactOf<v1::CheckRecipe>(DecodeCheckRecipe, EncodeCheckRecipe)},
      {"fuse_recipe", ArtifactOf<v1::FuseRecipe>(DecodeFuseRecipe, EncodeFuseRecipe)},
      {"tile_runs", ArtifactOf<v1::TileRuns>(DecodeTileRuns, EncodeTileRuns)},
      {"tile_recipe", ArtifactOf<v1::TileRecipe>(DecodeTileRecipe, EncodeTileRecipe)},
      {"depth_map", ArtifactOf<v1::DepthMap>(DecodeDepthMap, EncodeDepthMap)},
      {"surface_points", ArtifactOf<v1::SurfacePoints>(DecodeSurfacePoints, EncodeSurfacePoints)},
      {"dense_tile", ArtifactOf<v1::DenseTile>(DecodeDenseTile, EncodeDenseTile)},
  };
}

Seeds LegalBytes() {
  Seeds seeds;
  AddArtifactSeeds(seeds);
  AddAdjustmentSeeds(seeds);
  AddDenseSeeds(seeds);
  return seeds;
}

class PoisonedArtifacts : public ::testing::TestWithParam<std::string> {};

TEST_P(PoisonedArtifacts, AreRefusedOrMeanTheSameEverAfter) {
  const Artifact artifact = Artifacts().at(GetParam());
  Message& message = *artifact.message;
  size_t looked_at = 0;
  MessagePoisoner poisoner([&](const std::string& field, const std::string& poison, bool is_real) {
    ++looked_at;
    SCOPED_TRACE(field + " = " + poison);
    const bool is_refused = artifact.reencode(message.SerializeAsString()).empty();
    EXPECT_TRUE(is_refused || !is_real || kMayBeAnything.contains(field)) << "it is taken";
  });
  const std::vector<std::string> seeds = LegalBytes().at(GetParam());
  for (const std::string& legal : seeds) {
    ASSERT_TRUE(message.ParseFromString(legal));
    ASSERT_EQ(artifact.reencode(legal), legal) << "a legal one";
    poisoner.Visit(message);
    EXPECT_EQ(message.SerializeAsString(), legal) << "the test leaves no poison behind";
  }
  EXPECT_GT(looked_at, 0U);
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const auto& [name, artifact] : Artifacts()) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All,
                         PoisonedArtifacts,
                         ::testing::ValuesIn(Names()),
                         [](const auto& test) { return test.param; });

/// Which artifact lacks here is one that stages read unlooked at.
TEST(PoisonedArtifacts, AreAllArtifactsWithNumbers) {
  std::set<std::string> known;
  for (const std::string& name : Names()) known.insert(name);
  for (const auto& [name, bytes] : LegalBytes()) {
    const bool has_no_numbers =
        name == "cluster_names" || name == "extract_recipe" || name == "collection";
    EXPECT_TRUE(has_no_numbers || known.contains(name)) << name;
  }
}

}  // namespace
}  // namespace orbweave
