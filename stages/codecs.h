// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pipeline/job_plan.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/carrier_codec.h"
#include "proto/codec/features_codec.h"
#include "proto/codec/inspection_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/pairs_codec.h"
#include "proto/codec/recipes_codec.h"
#include "proto/codec/reconstruction_codec.h"
#include "proto/codec/seams_codec.h"
#include "proto/codec/subproblem_codec.h"
#include "proto/codec/two_view_codec.h"
#include "stages/port.h"

/// Bytes of what the stages of the sparse line hand on.

namespace orbweave {

template <>
struct Codec<ImageSources> {
  static constexpr std::string_view kName = "image_sources";
  static constexpr auto Encode = EncodeImageSources;
  static constexpr auto Decode = DecodeImageSources;
};

template <>
struct Codec<ClusterNames> {
  static constexpr std::string_view kName = "cluster_names";
  static constexpr auto Encode = EncodeClusterNames;
  static constexpr auto Decode = DecodeClusterNames;
};

template <>
struct Codec<ImageManifest> {
  static constexpr std::string_view kName = "image_manifest";
  static constexpr auto Encode = EncodeImageManifest;
  static constexpr auto Decode = DecodeImageManifest;
};

template <>
struct Codec<ExtractRecipe> {
  static constexpr std::string_view kName = "extract_recipe";
  static constexpr auto Encode = EncodeExtractRecipe;
  static constexpr auto Decode = DecodeExtractRecipe;
};

template <>
struct Codec<Features> {
  static constexpr std::string_view kName = "features";
  static constexpr auto Encode = EncodeFeatures;
  static constexpr auto Decode = DecodeFeatures;
};

template <>
struct Codec<PlaceSample> {
  static constexpr std::string_view kName = "place_sample";
  static constexpr auto Encode = EncodePlaceSample;
  static constexpr auto Decode = DecodePlaceSample;
};

template <>
struct Codec<MatchRecipe> {
  static constexpr std::string_view kName = "match_recipe";
  static constexpr auto Encode = EncodeMatchRecipe;
  static constexpr auto Decode = DecodeMatchRecipe;
};

template <>
struct Codec<std::vector<TwoViewGeometry>> {
  static constexpr std::string_view kName = "two_view_geometries";
  static constexpr auto Encode = EncodeTwoViewGeometries;
  static constexpr auto Decode = DecodeTwoViewGeometries;
};

template <>
struct Codec<PairCandidates> {
  static constexpr std::string_view kName = "pair_candidates";
  static constexpr auto Encode = EncodePairCandidates;
  static constexpr auto Decode = DecodePairCandidates;
};

template <>
struct Codec<std::vector<Carrier>> {
  static constexpr std::string_view kName = "carriers";
  static constexpr auto Encode = EncodeCarriers;
  static constexpr auto Decode = DecodeCarriers;
};

template <>
struct Codec<std::vector<MatchedPair>> {
  static constexpr std::string_view kName = "matched_pairs";
  static constexpr auto Encode = EncodeMatchedPairs;
  static constexpr auto Decode = DecodeMatchedPairs;
};

template <>
struct Codec<WiderPairs> {
  static constexpr std::string_view kName = "wider_pairs";
  static constexpr auto Encode = EncodeWiderPairs;
  static constexpr auto Decode = DecodeWiderPairs;
};

template <>
struct Codec<DividedViewGraph> {
  static constexpr std::string_view kName = "divided_view_graph";
  static constexpr auto Encode = EncodeDividedViewGraph;
  static constexpr auto Decode = DecodeDividedViewGraph;
};

template <>
struct Codec<ClusterRecipe> {
  static constexpr std::string_view kName = "cluster_recipe";
  static constexpr auto Encode = EncodeClusterRecipe;
  static constexpr auto Decode = DecodeClusterRecipe;
};

template <>
struct Codec<ClusterResult> {
  static constexpr std::string_view kName = "cluster_result";
  static constexpr auto Encode = EncodeClusterResult;
  static constexpr auto Decode = DecodeClusterResult;
};

template <>
struct Codec<std::vector<Digest>> {
  static constexpr std::string_view kName = "collection";
  static constexpr auto Encode = EncodeCollection;
  static constexpr auto Decode = DecodeCollection;
};

template <>
struct Codec<SeamsOfCluster> {
  static constexpr std::string_view kName = "seams_of_cluster";
  static constexpr auto Encode = EncodeSeamsOfCluster;
  static constexpr auto Decode = DecodeSeamsOfCluster;
};

template <>
struct Codec<Alignment> {
  static constexpr std::string_view kName = "alignment";
  static constexpr auto Encode = EncodeAlignment;
  static constexpr auto Decode = DecodeAlignment;
};

template <>
struct Codec<PartitionReview> {
  static constexpr std::string_view kName = "partition_review";
  static constexpr auto Encode = EncodePartitionReview;
  static constexpr auto Decode = DecodePartitionReview;
};

template <>
struct Codec<std::vector<JoinedWorld>> {
  static constexpr std::string_view kName = "joined_worlds";
  static constexpr auto Encode = EncodeJoinedWorlds;
  static constexpr auto Decode = DecodeJoinedWorlds;
};

template <>
struct Codec<AssembleRecipe> {
  static constexpr std::string_view kName = "assemble_recipe";
  static constexpr auto Encode = EncodeAssembleRecipe;
  static constexpr auto Decode = DecodeAssembleRecipe;
};

template <>
struct Codec<Subproblem> {
  static constexpr std::string_view kName = "world_block";
  static constexpr auto Encode = EncodeSubproblem;
  static constexpr auto Decode = DecodeSubproblem;
};

template <>
struct Codec<EvaluatedState> {
  static constexpr std::string_view kName = "block_state";
  static constexpr auto Encode = EncodeSubproblemState;
  static constexpr auto Decode = DecodeSubproblemState;
};

template <>
struct Codec<SubproblemTask> {
  static constexpr std::string_view kName = "block_task";
  static constexpr auto Encode = EncodeSubproblemTask;
  static constexpr auto Decode = DecodeSubproblemTask;
};

template <>
struct Codec<SubproblemResult> {
  static constexpr std::string_view kName = "block_result";
  static constexpr auto Encode = EncodeSubproblemResult;
  static constexpr auto Decode = DecodeSubproblemResult;
};

template <>
struct Codec<SubproblemInspection> {
  static constexpr std::string_view kName = "block_inspection";
  static constexpr auto Encode = EncodeSubproblemInspection;
  static constexpr auto Decode = DecodeSubproblemInspection;
};

template <>
struct Codec<AdjustmentProgress> {
  static constexpr std::string_view kName = "adjustment_progress";
  static constexpr auto Encode = EncodeAdjustmentProgress;
  static constexpr auto Decode = DecodeAdjustmentProgress;
};

template <>
struct Codec<FinalisedModel> {
  static constexpr std::string_view kName = "concluded_model";
  static constexpr auto Encode = EncodeFinalisedModel;
  static constexpr auto Decode = DecodeFinalisedModel;
};

}  // namespace orbweave
