// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_plan.h"
#include "proto/codec/carrier_codec.h"
#include "proto/codec/features_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/pairs_codec.h"
#include "proto/codec/recipes_codec.h"
#include "proto/codec/reconstruction_codec.h"
#include "proto/codec/seams_codec.h"
#include "proto/codec/two_view_codec.h"
#include "tests/fuzz/artifact_values.h"
#include "tests/fuzz/seeds.h"

namespace orbweave {
namespace {

void AddFeatures(Seeds& seeds) {
  const Features features{.camera = {64, 32},
                          .keypoints = {{1.5F, 2.5F, 1.0F, 0.5F}, {9.0F, 8.0F, 2.0F, -0.5F}},
                          .sigma_rad = {1e-3F, 2e-3F},
                          .descriptors = std::vector<uint8_t>(2 * kDescriptorSize, 7),
                          .colors = {{1, 2, 3}, {4, 5, 6}}};
  seeds["features"] = {EncodeFeatures(features).value(),
                       EncodeFeatures({.problem = "truncated"}).value()};
  seeds["place_sample"] = {
      EncodePlaceSample(
          {.num_features = 9, .descriptors = std::vector<uint8_t>(kDescriptorSize, 4)})
          .value()};
}

void AddManifest(Seeds& seeds) {
  SourceImage image{.name = "a/b.jpg", .content = DigestOf("a"), .size_bytes = 7};
  image.metadata = {.width_px = 100, .height_px = 50, .heading_deg = 0.0, .capture_time_s = 1.5};
  image.metadata.position = GeodeticPosition{47.0, 8.0, 400.0};
  image.mask_path = "b.png";
  image.mask = DigestOf("m");
  image.position_in_local = Eigen::Vector3d(1, 2, 3);
  image.position_sigma_m = Eigen::Vector2d(0.5, 1.0);
  seeds["image_sources"] = {
      EncodeImageSources(
          {.images = {image}, .gnss_text = "name,x,y,z", .gnss_name = "g.csv", .warnings = {"w"}})
          .value()};
  seeds["cluster_names"] = {EncodeClusterNames({{"a.jpg", "north"}, {"b.jpg", "south"}}).value()};
  ImageManifest manifest{.excluded = {{"c.jpg", "not 2:1"}}, .warnings = {"row 3"}};
  manifest.origin = GeodeticPosition{47.5, 8.5, 400.0};
  ImageRecord& record = manifest.images.emplace_back();
  record = {.name = "a/b.jpg", .content = DigestOf("a"), .camera = {100, 50}, .drive = 2};
  record.prior.position_in_enu = Eigen::Vector3d(1, 2, 3);
  record.prior.heading_deg = 0.0;
  seeds["image_manifest"] = {EncodeImageManifest(manifest).value()};
}

void AddViewGraph(Seeds& seeds) {
  TwoViewGeometry pair{.pair = {ImageId(2), ImageId(9)}, .kind = TwoViewKind::kPlanar};
  pair.b_from_a.translation = Eigen::Vector3d(0.6, 0.0, 0.8);
  pair.inliers = {{1, 5}, {2, 4}};
  seeds["two_view_geometries"] = {EncodeTwoViewGeometries({pair, pair}).value()};
  const std::vector<ImagePair> pairs = {{ImageId(0), ImageId(3)}, {ImageId(1), ImageId(2)}};
  seeds["pair_candidates"] = {
      EncodePairCandidates({.first = pairs, .second = pairs, .reserve = pairs}).value()};
  seeds["carriers"] = {
      EncodeCarriers({{.images = {ImageId(0), ImageId(3)}, .cells = {7, 4095}}}).value()};
  const Rigid3& pose = pair.b_from_a;
  seeds["matched_pairs"] = {
      EncodeMatchedPairs({{.pair = pairs[0], .kind = TwoViewKind::kGeneral, .b_from_a = pose},
                          {.pair = pairs[1], .kind = TwoViewKind::kPureRotation}})
          .value()};
  seeds["wider_pairs"] = {EncodeWiderPairs({.decisions = 2,
                                            .second = pairs,
                                            .reserve = pairs,
                                            .predicted = {{pairs[0], PredictPose(pose, pose)}},
                                            .num_held_back = 5,
                                            .num_thin_images = 1})
                              .value()};
  DividedViewGraph divided{.dropped = {{{ImageId(0), ImageId(7)}, "loop"}},
                           .edges = {{ImageId(0), ImageId(1)}},
                           .edge_kinds = {1},
                           .edge_rungs = {1},
                           .crossing = {{{ImageId(0), ImageId(1)}, pose}}};
  divided.partition.clusters = {{.images = {ImageId(0), ImageId(1)}, .interior = {ImageId(0)}},
                                {.images = {ImageId(1), ImageId(7)}, .interior = {ImageId(7)}}};
  divided.partition.seams = {{.cluster_a = 0, .cluster_b = 1, .shared = {ImageId(1)}}};
  seeds["divided_view_graph"] = {EncodeDividedViewGraph(divided).value()};
}

void AddRecipes(Seeds& seeds) {
  const Digest digest = DigestOf("blob");
  const std::vector<FeatureFile> images = {{ImageId(1), digest}, {ImageId(4), digest}};
  seeds["extract_recipe"] = {EncodeExtractRecipe({.image = digest, .mask = digest}).value()};
  seeds["match_recipe"] = {EncodeMatchRecipe({.images = images,
                                              .pairs = {{{ImageId(1), ImageId(4)}, {{3, 4}}}},
                                              .carriers = {{.images = {ImageId(4)}, .cells = {7}}}})
                               .value()};
  seeds["cluster_recipe"] = {EncodeClusterRecipe({.cluster = 3,
                                                  .images = images,
                                                  .drives = {0, 7},
                                                  .ranks = {3, 0},
                                                  .pairs = {{ImageId(1), ImageId(4)}},
                                                  .shared = {ImageId(4)},
                                                  .matches = {digest}})
                                 .value()};
  seeds["collection"] = {EncodeCollection({digest, DigestOf("other")})};
}

void AddModels(Seeds& seeds) {
  seeds["reconstruction"] = {EncodeReconstruction(TwoViewsOfAPoint()).value()};
  seeds["cluster_result"] = {
      EncodeClusterResult(
          {.cluster = 4,
           .reconstruction = {.submodels = {TwoViewsOfAPoint()},
                              .not_registered = {{ImageId(77), "no verified matches"}},
                              .contradicted_pairs = {{ImageId(3), ImageId(8)}},
                              .parted_pairs = {{{ImageId(4), ImageId(9)}}},
                              .start_remark = "remark"}})
          .value()};
  Alignment alignment{
      .world_from_submodel = {Sim3{2.0, Eigen::Quaterniond::Identity(), {1, 2, 3}}, Sim3{}},
      .world = {0, 0},
      .submodels = {{.cluster = 4, .num_images = 7}, {.cluster = 5, .num_images = 6}}};
  alignment.seams.push_back({.submodel_a = 0, .submodel_b = 1, .reason = "loop"});
  seeds["alignment"] = {EncodeAlignment(alignment).value()};
  seeds["seams_of_cluster"] = {
      EncodeSeamsOfCluster(
          {.submodels = {{.name = {4, 0},
                          .images = {ImageId(0), ImageId(2)},
                          .length = 2.0,
                          .level = SubmodelLevel{}}},
           .seams = {{.a = {4, 0}, .b = {5, 1}, .common_tracks = 3, .shared = {{}, {}}}}})
          .value()};
  seeds["partition_review"] = {
      EncodePartitionReview({.rounds = 2, .requests = {{1, 3, 24, "too few"}}}).value()};
}

}  // namespace

void AddArtifactSeeds(Seeds& seeds) {
  AddFeatures(seeds);
  AddManifest(seeds);
  AddViewGraph(seeds);
  AddRecipes(seeds);
  AddModels(seeds);
}

}  // namespace orbweave
