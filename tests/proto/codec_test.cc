// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The law of every codec: decode(encode(x)) = x, encode is a function of x alone, and bytes that
// are not whole are an error, never a crash.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/features_codec.h"
#include "proto/codec/inspection_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/pack.h"
#include "proto/codec/recipes_codec.h"
#include "proto/codec/reconstruction_codec.h"
#include "proto/codec/seams_codec.h"
#include "proto/codec/subproblem_codec.h"
#include "proto/codec/two_view_codec.h"

namespace orbweave {
namespace {

Features SomeFeatures(size_t n) {
  Random random(7);
  Features features{.camera = {2048, 1024}};
  for (size_t i = 0; i < n; ++i) {
    features.keypoints.push_back({static_cast<float>(random.Uniform(0, 2048)),
                                  static_cast<float>(random.Uniform(0, 1024)),
                                  static_cast<float>(random.Uniform(1, 9)),
                                  static_cast<float>(random.Uniform(-3, 3))});
    features.sigma_rad.push_back(static_cast<float>(random.Uniform(1e-3, 2e-3)));
    features.colors.push_back({static_cast<uint8_t>(random.Index(256)), 3, 200});
    for (int k = 0; k < kDescriptorSize; ++k)
      features.descriptors.push_back(static_cast<uint8_t>(random.Index(256)));
  }
  return features;
}

Reconstruction SomeReconstruction() {
  Random random(11);
  Reconstruction reconstruction;
  for (uint32_t i = 0; i < 5; ++i) {
    const Eigen::Vector3d w(random.Normal(), random.Normal(), random.Normal());
    reconstruction.images[ImageId(3 * i)] = {
        Rigid3::FromCentre(RotationFromVector(w), Eigen::Vector3d(i, random.Normal(), 0.1)),
        i == 4};
  }
  Eigen::Matrix3d covariance;
  covariance << 1.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 4.0;
  reconstruction.images[ImageId(6)].uncertainty = {covariance, 0.25};
  for (uint32_t p = 0; p < 20; ++p) {
    Track track{.point_in_world = {random.Normal(), random.Normal(), random.Normal()},
                .color = {1, 2, 250}};
    for (uint32_t i = 0; i < 2 + p % 3; ++i) {
      const Eigen::Vector3d ray(random.Normal(), random.Normal(), random.Normal());
      track.observations.push_back({{ImageId(3 * i), p}, ray.normalized(), 1e-3 * (1 + i)});
    }
    reconstruction.tracks.push_back(std::move(track));
  }
  return reconstruction;
}

void ExpectSame(const Reconstruction& a, const Reconstruction& b) {
  ASSERT_EQ(a.images.size(), b.images.size());
  for (const auto& [id, image] : a.images) {
    ASSERT_TRUE(b.images.contains(id));
    EXPECT_EQ(image.cam_from_world.translation, b.images.at(id).cam_from_world.translation);
    EXPECT_EQ(image.cam_from_world.rotation.coeffs(),
              b.images.at(id).cam_from_world.rotation.coeffs());
    EXPECT_EQ(image.loose, b.images.at(id).loose);
    ASSERT_EQ(image.uncertainty.has_value(), b.images.at(id).uncertainty.has_value());
    if (!image.uncertainty) continue;
    EXPECT_EQ(image.uncertainty->position_covariance,
              b.images.at(id).uncertainty->position_covariance);
    EXPECT_EQ(image.uncertainty->rotation_sigma_rad,
              b.images.at(id).uncertainty->rotation_sigma_rad);
  }
  ASSERT_EQ(a.tracks.size(), b.tracks.size());
  for (size_t t = 0; t < a.tracks.size(); ++t) {
    EXPECT_EQ(a.tracks[t].point_in_world, b.tracks[t].point_in_world);
    EXPECT_EQ(a.tracks[t].color, b.tracks[t].color);
    ASSERT_EQ(a.tracks[t].observations.size(), b.tracks[t].observations.size());
    for (size_t k = 0; k < a.tracks[t].observations.size(); ++k) {
      EXPECT_EQ(a.tracks[t].observations[k].ref, b.tracks[t].observations[k].ref);
      EXPECT_EQ(a.tracks[t].observations[k].bearing, b.tracks[t].observations[k].bearing);
      EXPECT_EQ(a.tracks[t].observations[k].sigma_rad, b.tracks[t].observations[k].sigma_rad);
    }
  }
}

/// Every prefix of an encoding decodes to an error or to something well-formed; none crashes.
template <typename Decode>
void DecodePrefixes(const std::string& bytes, Decode decode) {
  const size_t step = std::max<size_t>(1, bytes.size() / 200);
  size_t errors = 0;
  for (size_t n = 0; n < bytes.size(); n += step) {
    if (!decode(std::string_view(bytes).substr(0, n)).ok()) ++errors;
  }
  EXPECT_GT(errors, 0U);
}

TEST(FeaturesCodec, RoundTripsExactly) {
  const Features in = SomeFeatures(50);
  const auto out = DecodeFeatures(EncodeFeatures(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  EXPECT_EQ(out->camera, in.camera);
  EXPECT_EQ(out->descriptors, in.descriptors);
  EXPECT_EQ(out->sigma_rad, in.sigma_rad);
  EXPECT_EQ(out->colors, in.colors);
  ASSERT_EQ(out->size(), in.size());
  for (size_t i = 0; i < in.size(); ++i) EXPECT_EQ(out->keypoints[i].x_px, in.keypoints[i].x_px);
  EXPECT_EQ(EncodeFeatures(*out).value(), EncodeFeatures(in).value());
  DecodePrefixes(EncodeFeatures(in).value(), DecodeFeatures);
}

TEST(FeaturesCodec, KeepsFeaturesWithoutDescriptorsAndProblems) {
  Features in = SomeFeatures(3);
  in.descriptors.clear();
  in.problem = "cannot decode";
  const auto out = DecodeFeatures(EncodeFeatures(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  EXPECT_TRUE(out->descriptors.empty());
  EXPECT_EQ(out->problem, in.problem);
}

TEST(FeaturesCodec, KeepsViewsThatAreInOrder) {
  Features in = SomeFeatures(4);
  in.view = {0, 0, 1, 8};
  EXPECT_EQ(DecodeFeatures(EncodeFeatures(in).value())->view, in.view);
  const std::vector<std::vector<uint8_t>> refused = {{0, 1, 0, 2}, {0, 0, 0, 9}, {0, 1}};
  for (const std::vector<uint8_t>& view : refused) {
    in.view = view;
    EXPECT_EQ(DecodeFeatures(EncodeFeatures(in).value()).status().code(),
              absl::StatusCode::kDataLoss);
  }
}

TEST(FeaturesCodec, RefusesArraysOfDifferentLengths) {
  Features in = SomeFeatures(3);
  in.sigma_rad.pop_back();
  EXPECT_EQ(DecodeFeatures(EncodeFeatures(in).value()).status().code(),
            absl::StatusCode::kDataLoss);
}

TEST(PlaceSampleCodec, RoundTrips) {
  const PlaceSample in{
      .num_features = 9, .descriptors = std::vector<uint8_t>(256, 4), .problem = "x"};
  const auto out = DecodePlaceSample(EncodePlaceSample(in).value());
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->num_features, 9U);
  EXPECT_EQ(out->descriptors, in.descriptors);
  EXPECT_EQ(out->problem, "x");
}

TEST(TwoViewCodec, RoundTripsExactly) {
  TwoViewGeometry in{.pair = {ImageId(2), ImageId(9)}, .kind = TwoViewKind::kPlanar};
  in.b_from_a = {RotationFromVector({0.1, 2.0, -0.3}), Eigen::Vector3d(0.6, 0.0, 0.8)};
  in.inliers = {{1, 5}, {2, 4}};
  in.num_putative = 7;
  in.median_angle_rad = 0.25;
  in.spread = 0.5;
  const std::string bytes = EncodeTwoViewGeometries({in, in}).value();
  const auto out = DecodeTwoViewGeometries(bytes);
  ASSERT_TRUE(out.ok()) << out.status();
  ASSERT_EQ(out->size(), 2U);
  EXPECT_EQ((*out)[1].pair, in.pair);
  EXPECT_EQ((*out)[1].kind, in.kind);
  EXPECT_EQ((*out)[1].inliers, in.inliers);
  EXPECT_EQ((*out)[1].b_from_a.translation, in.b_from_a.translation);
  EXPECT_EQ((*out)[1].spread, in.spread);
  EXPECT_EQ(EncodeTwoViewGeometries(*out).value(), bytes);
  DecodePrefixes(bytes, DecodeTwoViewGeometries);
}

TEST(TwoViewCodec, RefusesPairsOutOfOrder) {
  const TwoViewGeometry in{.pair = {ImageId(9), ImageId(2)}};
  EXPECT_FALSE(DecodeTwoViewGeometries(EncodeTwoViewGeometries({in}).value()).ok());
}

TEST(RecipesCodec, RoundTrip) {
  const Digest digest = DigestOf("features");
  const MatchRecipe match{.images = {{ImageId(1), digest}, {ImageId(4), DigestOf("b")}},
                          .pairs = {{{ImageId(1), ImageId(4)}, {{3, 4}}}}};
  const auto match_out = DecodeMatchRecipe(EncodeMatchRecipe(match).value());
  ASSERT_TRUE(match_out.ok()) << match_out.status();
  EXPECT_EQ(match_out->images[0].features, digest);
  EXPECT_EQ(match_out->pairs[0].matches, match.pairs[0].matches);
  EXPECT_FALSE(match_out->pairs[0].predicted.has_value());
  MatchRecipe again = match;
  again.pairs[0].predicted = PredictedPose{.last = Eigen::Vector3d::UnitZ()};
  const auto again_out = DecodeMatchRecipe(EncodeMatchRecipe(again).value());
  ASSERT_TRUE(again_out.ok()) << again_out.status();
  ASSERT_TRUE(again_out->pairs[0].predicted.has_value());
  EXPECT_EQ(again_out->pairs[0].predicted->first, Eigen::Vector3d::UnitX());
  EXPECT_EQ(again_out->pairs[0].predicted->last, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(again_out->carriers.empty());
  again.carriers = {{.images = {ImageId(4)}, .cells = {0, 4095}}};
  EXPECT_EQ(DecodeMatchRecipe(EncodeMatchRecipe(again).value())->carriers, again.carriers);
  again.carriers[0].images = {ImageId(5)};
  EXPECT_FALSE(DecodeMatchRecipe(EncodeMatchRecipe(again).value()).ok()) << "of no image";

  const ClusterRecipe cluster{.cluster = 3,
                              .images = match.images,
                              .drives = {0, 7},
                              .ranks = {3, 0},
                              .pairs = {{ImageId(1), ImageId(4)}},
                              .matches = {digest},
                              .fixes = {{ImageId(4), {1.5, -2.0, 0.25}, 3.0, 6.0, true}}};
  const auto cluster_out = DecodeClusterRecipe(EncodeClusterRecipe(cluster).value());
  ASSERT_TRUE(cluster_out.ok()) << cluster_out.status();
  EXPECT_EQ(cluster_out->cluster, 3U);
  EXPECT_EQ(cluster_out->pairs, cluster.pairs);
  EXPECT_EQ(cluster_out->matches, cluster.matches);
  EXPECT_EQ(cluster_out->fixes, cluster.fixes);
  EXPECT_EQ(cluster_out->drives, cluster.drives);
  EXPECT_EQ(cluster_out->ranks, cluster.ranks);

  const ExtractRecipe extract{
      .image = digest, .mask = {}, .mask_ignores_white = false, .wants_facades = true};
  const auto extract_out = DecodeExtractRecipe(EncodeExtractRecipe(extract).value());
  EXPECT_TRUE(extract_out->wants_facades);
  ASSERT_TRUE(extract_out.ok()) << extract_out.status();
  EXPECT_EQ(extract_out->image, digest);
  EXPECT_TRUE(extract_out->mask.IsZero());
  EXPECT_FALSE(extract_out->mask_ignores_white);
}

TEST(RecipesCodec, RefusesAPositionThatIsNoneOrOfNoImage) {
  ClusterRecipe cluster{.images = {{ImageId(1), DigestOf("a")}},
                        .drives = {0},
                        .ranks = {0},
                        .fixes = {{ImageId(1), {1.0, 2.0, 3.0}, 3.0, 6.0}}};
  ASSERT_TRUE(DecodeClusterRecipe(EncodeClusterRecipe(cluster).value()).ok());
  cluster.fixes[0].horizontal_sigma_m = 0.0;
  EXPECT_FALSE(DecodeClusterRecipe(EncodeClusterRecipe(cluster).value()).ok());
  cluster.fixes[0] = {ImageId(2), {1.0, 2.0, 3.0}, 3.0, 6.0};
  EXPECT_FALSE(DecodeClusterRecipe(EncodeClusterRecipe(cluster).value()).ok());
}

TEST(RecipesCodec, RefusesOtherThanOneDriveForEachImage) {
  ClusterRecipe cluster{.images = {{ImageId(1), DigestOf("a")}}};
  EXPECT_FALSE(DecodeClusterRecipe(EncodeClusterRecipe(cluster).value()).ok());
  cluster.drives = {2};
  EXPECT_FALSE(DecodeClusterRecipe(EncodeClusterRecipe(cluster).value()).ok()) << "no rank";
  cluster.ranks = {0};
  EXPECT_TRUE(DecodeClusterRecipe(EncodeClusterRecipe(cluster).value()).ok());
  cluster.drives = {2, 2};
  cluster.ranks = {0, 1};
  EXPECT_FALSE(DecodeClusterRecipe(EncodeClusterRecipe(cluster).value()).ok());
}

TEST(RecipesCodec, RefusesAPairWithoutItsImages) {
  const MatchRecipe match{.images = {{ImageId(1), DigestOf("a")}},
                          .pairs = {{{ImageId(1), ImageId(4)}, {}}}};
  EXPECT_FALSE(DecodeMatchRecipe(EncodeMatchRecipe(match).value()).ok());
}

TEST(SourcesCodec, KeepsWhatIngestLooksAtAndNoPaths) {
  ImageSources in{.mask_ignores_white = false,
                  .gnss_text = "name,latitude",
                  .gnss_name = "g.csv",
                  .warnings = {"w"}};
  SourceImage image{
      .name = "a.jpg", .path = "/somewhere/a.jpg", .content = DigestOf("a"), .size_bytes = 7};
  image.metadata = {.width_px = 100, .height_px = 50};
  image.metadata.position = GeodeticPosition{47.0, 8.0, 400.0};
  image.metadata.altitude_known = image.metadata.altitude_of_ellipsoid = true;
  image.mask_path = "/somewhere/masks/a.png";
  image.mask = DigestOf("m");
  image.mask_width_px = 100;
  image.mask_height_px = 50;
  image.position_in_local = Eigen::Vector3d(1, 2, 3);
  image.position_sigma_m = Eigen::Vector2d(0.5, 1.0);
  in.images.push_back(image);
  const std::string bytes = EncodeImageSources(in).value();
  EXPECT_EQ(bytes.find("somewhere"), std::string::npos);
  const auto out = DecodeImageSources(bytes);
  ASSERT_TRUE(out.ok()) << out.status();
  ASSERT_EQ(out->images.size(), 1U);
  EXPECT_EQ(out->images[0].mask, image.mask);
  EXPECT_EQ(out->images[0].mask_path, "a.png");
  EXPECT_EQ(out->images[0].mask_width_px, 100);
  EXPECT_EQ(out->images[0].metadata.width_px, 100);
  EXPECT_EQ(out->images[0].metadata.position->altitude_m, 400.0);
  EXPECT_TRUE(out->images[0].metadata.altitude_of_ellipsoid);
  EXPECT_EQ(out->images[0].position_in_local, image.position_in_local);
  EXPECT_EQ(out->images[0].position_sigma_m, image.position_sigma_m);
  EXPECT_EQ(out->gnss_text, in.gnss_text);
  EXPECT_FALSE(out->mask_ignores_white);
  EXPECT_EQ(EncodeImageSources(*out).value(), bytes);
}

// What protobuf does silently beyond 2 GiB, with a smaller limit.
TEST(Serialize, RefusesMoreThanTheLimit) {
  v1::Features message;
  message.set_problem(std::string(100, 'x'));
  const size_t size = message.ByteSizeLong();
  const auto fits = codec::Serialize(message, "features", codec::Empty::kIsRefused, size);
  ASSERT_TRUE(fits.ok());
  EXPECT_EQ(*fits, message.SerializeAsString());
  const auto status =
      codec::Serialize(message, "features", codec::Empty::kIsRefused, size - 1).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kOutOfRange);
  EXPECT_NE(status.message().find("features"), std::string::npos);
}

TEST(Serialize, RefusesAnEmptyMessageUnlessThatIsAValue) {
  EXPECT_EQ(codec::Serialize(v1::Features(), "features").status().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(codec::Serialize(v1::Features(), "features", codec::Empty::kIsLegal).value(), "");
}

TEST(Parse, TakesNoBytesForAnArtifactOnlyWhereTheyAreAValue) {
  for (const absl::Status& status : {DecodeImageSources("").status(),
                                     DecodeImageManifest("").status(),
                                     DecodeFeatures("").status(),
                                     DecodeExtractRecipe("").status(),
                                     DecodeMatchRecipe("").status(),
                                     DecodeClusterRecipe("").status(),
                                     DecodeSubproblem("").status(),
                                     DecodeAssembleRecipe("").status(),
                                     DecodeSubproblemTask("").status(),
                                     DecodeSubproblemResult("").status(),
                                     DecodeSubproblemInspection("").status()}) {
    EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss) << status;
  }
  // Inputs of loops before the first round.
  EXPECT_TRUE(DecodePartitionReview("").ok());
  EXPECT_TRUE(DecodeDividedViewGraph("").ok());
  EXPECT_TRUE(DecodeAdjustmentProgress("").ok());
  // Lists that may be empty.
  EXPECT_EQ(EncodeTwoViewGeometries({}).value(), "");
  EXPECT_TRUE(DecodeTwoViewGeometries("")->empty());
}

TEST(Parse, LeavesAMessageOfUnknownFieldsToItsDecoder) {
  const std::string unknown("\x98\x06\x07", 3);  // field 99: 7
  EXPECT_FALSE(DecodeImageSources(unknown).ok());
  EXPECT_FALSE(DecodeImageManifest(unknown).ok());
  EXPECT_FALSE(DecodeExtractRecipe(unknown).ok());
  EXPECT_TRUE(DecodePartitionReview(unknown).ok());
}

TEST(ClusterNamesCodec, RoundTrips) {
  const ClusterNames clusters = {{"a/1.jpg", "north"}, {"b.jpg", "south"}};
  EXPECT_EQ(DecodeClusterNames(EncodeClusterNames(clusters).value()).value(), clusters);
  EXPECT_TRUE(DecodeClusterNames("")->empty());
}

TEST(ManifestCodec, RoundTrips) {
  ImageManifest in{
      .excluded = {{"c.jpg", "not 2:1"}}, .warnings = {"row 3"}, .mask_ignores_white = false};
  in.origin = GeodeticPosition{47.5, 8.5, 400.0};
  ImageRecord image{.id = ImageId(0),
                    .name = "a/b.jpg",
                    .content = DigestOf("a"),
                    .camera = {100, 50},
                    .drive = 2};
  image.capture_time_s = 12.5;
  image.prior.geodetic = in.origin;
  image.prior.position_in_enu = Eigen::Vector3d(1, 2, 3);
  image.prior.heading_deg = 0.0;
  image.prior.heading_sigma_deg = 0.25;
  image.prior.tilt_sigma_deg = 0.125;
  in.images.push_back(image);
  const std::string bytes = EncodeImageManifest(in).value();
  const auto out = DecodeImageManifest(bytes);
  ASSERT_TRUE(out.ok()) << out.status();
  ASSERT_EQ(out->images.size(), 1U);
  EXPECT_EQ(out->images[0].name, "a/b.jpg");
  EXPECT_EQ(out->images[0].content, image.content);
  EXPECT_EQ(out->images[0].prior.position_in_enu, image.prior.position_in_enu);
  EXPECT_EQ(out->images[0].prior.heading_deg, image.prior.heading_deg);
  EXPECT_FALSE(out->images[0].prior.pitch_deg.has_value());
  EXPECT_EQ(out->images[0].prior.heading_sigma_deg, 0.25);
  EXPECT_EQ(out->images[0].prior.tilt_sigma_deg, 0.125);
  EXPECT_EQ(out->images[0].capture_time_s, 12.5);
  EXPECT_EQ(out->excluded[0].reason, "not 2:1");
  EXPECT_FALSE(out->mask_ignores_white);
  EXPECT_EQ(EncodeImageManifest(*out).value(), bytes);
}

TEST(ManifestCodec, RefusesASigmaThatIsNone) {
  for (const double sigma_deg : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    ImageManifest manifest;
    manifest.images.push_back({.name = "a.jpg", .camera = {100, 50}});
    manifest.images[0].prior.heading_sigma_deg = sigma_deg;
    EXPECT_FALSE(DecodeImageManifest(EncodeImageManifest(manifest).value()).ok()) << sigma_deg;
    manifest.images[0].prior.heading_sigma_deg = 10.0;
    manifest.images[0].prior.tilt_sigma_deg = sigma_deg;
    EXPECT_FALSE(DecodeImageManifest(EncodeImageManifest(manifest).value()).ok()) << sigma_deg;
  }
}

TEST(ReconstructionCodec, RoundTripsExactly) {
  const Reconstruction in = SomeReconstruction();
  const auto out = DecodeReconstruction(EncodeReconstruction(in).value());
  ASSERT_TRUE(out.ok()) << out.status();
  ExpectSame(in, *out);
  DecodePrefixes(EncodeReconstruction(in).value(), DecodeReconstruction);
}

TEST(ReconstructionCodec, RefusesObservationsOfUnregisteredImages) {
  Reconstruction in = SomeReconstruction();
  in.images.erase(ImageId(0));
  EXPECT_FALSE(DecodeReconstruction(EncodeReconstruction(in).value()).ok());
}

TEST(ReconstructionCodec, RefusesUncertaintiesThatAreNoNumbers) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -1.0}) {
    Reconstruction in = SomeReconstruction();
    in.images[ImageId(6)].uncertainty->rotation_sigma_rad = bad;
    EXPECT_FALSE(DecodeReconstruction(EncodeReconstruction(in).value()).ok());
  }
}

TEST(ReconstructionCodec, RefusesBearingsOfAnotherLength) {
  Reconstruction in = SomeReconstruction();
  in.tracks[3].observations[0].bearing *= 2.0;
  EXPECT_FALSE(DecodeReconstruction(EncodeReconstruction(in).value()).ok());
}

TEST(ReconstructionCodec, RefusesPlacesThatNobodyCanComputeWith) {
  Reconstruction in = SomeReconstruction();
  in.tracks[3].point_in_world.x() = 1e20;  // rays that are all but parallel
  EXPECT_TRUE(DecodeReconstruction(EncodeReconstruction(in).value()).ok());
  in.tracks[3].point_in_world.x() = 1e40;
  EXPECT_FALSE(DecodeReconstruction(EncodeReconstruction(in).value()).ok());
  in = SomeReconstruction();
  in.images[ImageId(3)].cam_from_world.translation.z() = -1e10;
  EXPECT_FALSE(DecodeReconstruction(EncodeReconstruction(in).value()).ok());
  in = SomeReconstruction();
  in.tracks[3].observations[0].sigma_rad = 0.0;
  EXPECT_FALSE(DecodeReconstruction(EncodeReconstruction(in).value()).ok());
}

TEST(PartitionCodec, RefusesWhatIsNotBetweenItsClusters) {
  DividedViewGraph divided;
  divided.partition.clusters = {{.images = {ImageId(0), ImageId(1)}, .interior = {ImageId(0)}},
                                {.images = {ImageId(1), ImageId(2)}, .interior = {ImageId(2)}}};
  divided.partition.seams = {{.cluster_a = 0, .cluster_b = 1, .shared = {ImageId(1)}}};
  const auto is_taken = [](const DividedViewGraph& in) {
    return DecodeDividedViewGraph(EncodeDividedViewGraph(in).value()).ok();
  };
  ASSERT_TRUE(is_taken(divided));
  DividedViewGraph spoilt = divided;
  spoilt.partition.seams[0].cluster_b = 2;
  EXPECT_FALSE(is_taken(spoilt)) << "a cluster that there is not";
  spoilt = divided;
  spoilt.partition.seams[0].shared = {ImageId(2)};
  EXPECT_FALSE(is_taken(spoilt)) << "an image of one of them alone";
  spoilt = divided;
  spoilt.partition.clusters[0].images = {ImageId(1), ImageId(0)};
  EXPECT_FALSE(is_taken(spoilt)) << "no order";
  spoilt = divided;
  spoilt.partition.clusters[0].images = {ImageId(0), ImageId(0), ImageId(1)};
  EXPECT_FALSE(is_taken(spoilt)) << "an image twice";
  spoilt = divided;
  spoilt.partition.clusters[1].interior = {ImageId(3)};
  EXPECT_FALSE(is_taken(spoilt)) << "an interior elsewhere";
  spoilt = divided;
  spoilt.edges = {{ImageId(1), ImageId(0)}};
  spoilt.edge_kinds = {1};
  spoilt.edge_rungs = {1};
  EXPECT_FALSE(is_taken(spoilt)) << "a pair out of order";
  spoilt = divided;
  spoilt.crossing = {{.pair = {ImageId(0), ImageId(2)}}};
  EXPECT_FALSE(is_taken(spoilt)) << "no edge";
  spoilt.edges = {spoilt.crossing[0].pair};
  spoilt.edge_kinds = {1};
  spoilt.edge_rungs = {1};
  EXPECT_TRUE(is_taken(spoilt));
  spoilt.crossing[0].b_from_a.translation = Eigen::Vector3d(1.0, 1.0, 0.0);
  EXPECT_FALSE(is_taken(spoilt)) << "no direction";
}

TEST(RecipesCodec, RefuseImagesOutOfOrderAndPairsOfOthers) {
  const Digest digest = DigestOf("features");
  const ClusterRecipe recipe{.images = {{ImageId(1), digest}, {ImageId(4), digest}},
                             .drives = {0, 0},
                             .ranks = {0, 1},
                             .pairs = {{ImageId(1), ImageId(4)}},
                             .shared = {ImageId(4)}};
  const auto is_taken = [](const ClusterRecipe& in) {
    return DecodeClusterRecipe(EncodeClusterRecipe(in).value()).ok();
  };
  ASSERT_TRUE(is_taken(recipe));
  ClusterRecipe spoilt = recipe;
  std::swap(spoilt.images[0], spoilt.images[1]);
  EXPECT_FALSE(is_taken(spoilt));
  spoilt = recipe;
  spoilt.pairs = {{ImageId(1), ImageId(5)}};
  EXPECT_FALSE(is_taken(spoilt));
  spoilt = recipe;
  spoilt.pairs.push_back(spoilt.pairs[0]);
  EXPECT_FALSE(is_taken(spoilt));
  spoilt = recipe;
  spoilt.shared = {ImageId(2)};
  EXPECT_FALSE(is_taken(spoilt));
}

TEST(SubproblemCodec, RefusesTermsOfWhatItDoesNotHold) {
  Subproblem block{.scene = SomeReconstruction()};  // its last image is loose
  for (const auto& [id, image] : block.scene.images)
    block.images.push_back({.id = id, .camera = {64, 32}, .is_held = id == ImageId(0)});
  std::erase_if(block.scene.tracks, [](const Track& track) {
    return track.observations.back().ref.image >= ImageId(12);
  });
  block.priors = {{.image = ImageId(3), .bias_group = 1}};
  block.biases = {{.group = 1, .is_separator = true}};
  block.split = {{.id = 4, .part = block.scene.tracks[0]},
                 {.id = 6, .part = block.scene.tracks[1]}};
  block.farthest = ImageId(6);
  const auto is_taken = [](const Subproblem& in) {
    return DecodeSubproblem(EncodeSubproblem(in).value()).ok();
  };
  ASSERT_TRUE(is_taken(block));
  const std::map<std::string, void (*)(Subproblem&)> poisons = {
      {"a track of a loose image", [](Subproblem& b) { b.scene.images[ImageId(0)].loose = true; }},
      {"a prior of a loose image", [](Subproblem& b) { b.priors[0].image = ImageId(12); }},
      {"a prior of another bias", [](Subproblem& b) { b.priors[0].bias_group = 2; }},
      {"a bias that cannot move", [](Subproblem& b) { b.biases[0].sigma_m = 0.0; }},
      {"biases out of order", [](Subproblem& b) { b.biases.push_back({.group = 0}); }},
      {"a split track twice", [](Subproblem& b) { b.split[1].id = 4; }},
      {"split tracks beyond all", [](Subproblem& b) { b.split[1].id = 0x80000000U; }},
      {"a distance to a loose image", [](Subproblem& b) { b.farthest = ImageId(12); }},
      {"a distance from nothing", [](Subproblem& b) { b.images[0].is_held = false; }},
      {"a held image that moves", [](Subproblem& b) { b.images[0].is_separator = true; }},
      {"two held images", [](Subproblem& b) { b.images[1].is_held = true; }},
      {"a camera of no size", [](Subproblem& b) { b.images[0].camera.width_px = 0; }},
  };
  for (const auto& [what, poison] : poisons) {
    Subproblem spoilt = block;
    poison(spoilt);
    EXPECT_FALSE(is_taken(spoilt)) << what;
  }
}

TEST(SubproblemResultCodec, TakesAStepThatLedNowhereAndNoneThatGainsByNothing) {
  SubproblemResult result{.subproblem = DigestOf("block")};
  result.reply.trial.retained_points.resize(1);
  for (const double cost : {0.0, 7.5, std::numeric_limits<double>::infinity(), std::nan("")}) {
    result.reply.trial.cost = cost;
    EXPECT_TRUE(DecodeSubproblemResult(EncodeSubproblemResult(result).value()).ok()) << cost;
  }
  result.reply.trial.cost = -1.0;
  EXPECT_FALSE(DecodeSubproblemResult(EncodeSubproblemResult(result).value()).ok());
  result.reply.trial.cost = 1.0;
  result.reply.trial.retained_points[0].after[1].cost = -1.0;
  EXPECT_FALSE(DecodeSubproblemResult(EncodeSubproblemResult(result).value()).ok());
}

TEST(SeamsCodec, KeepsWhatIsUpInASubmodel) {
  SeamsOfCluster seams{.submodels = {{.name = {0, 0}}, {.name = {0, 1}}}};
  seams.submodels[1].level = SubmodelLevel{Eigen::Vector3d(0.6, 0.0, 0.8), 0.07};
  const auto decoded = DecodeSeamsOfCluster(EncodeSeamsOfCluster(seams).value());
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_FALSE(decoded->submodels[0].level.has_value());
  ASSERT_TRUE(decoded->submodels[1].level.has_value());
  EXPECT_EQ(decoded->submodels[1].level->up, Eigen::Vector3d(0.6, 0.0, 0.8));
  EXPECT_EQ(decoded->submodels[1].level->sigma_rad, 0.07);
  seams.submodels[1].level->up *= 2.0;
  EXPECT_FALSE(DecodeSeamsOfCluster(EncodeSeamsOfCluster(seams).value()).ok());
}

TEST(SeamsCodec, LooksAtTheCovarianceOfASeamThatHolds) {
  FittedSeam seam{.a = {0, 0}, .b = {1, 0}};
  const auto is_taken = [&] {
    return DecodeSeamsOfCluster(EncodeSeamsOfCluster({.seams = {seam}}).value()).ok();
  };
  EXPECT_TRUE(is_taken());
  seam.fit.covariance(2, 2) = -1.0;
  EXPECT_FALSE(is_taken());
  seam.fit.condition_number = std::numeric_limits<double>::infinity();  // nobody uses it
  EXPECT_TRUE(is_taken());
  seam.fit.condition_number = std::nan("");
  EXPECT_FALSE(is_taken());
  seam = {.a = {1, 0}, .b = {0, 0}};
  EXPECT_FALSE(is_taken());
}

TEST(ReconstructionCodec, RoundTripsResultsOfEveryStage) {
  const ClusterResult cluster{
      .cluster = 4,
      .reconstruction = {.submodels = {SomeReconstruction()},
                         .not_registered = {{ImageId(77), "no verified matches"}},
                         .contradicted_pairs = {{ImageId(3), ImageId(8)}},
                         .explained_pairs = {{ImageId(3), ImageId(4)}},
                         .parted_pairs = {{.pair = {ImageId(4), ImageId(9)},
                                           .b_from_a = {.translation = {0.6, 0.0, 0.8}}}},
                         .pair_lengths = {{.pair = {ImageId(3), ImageId(4)},
                                           .agreement = {.told = 80.5, .agreeing = 20.25}}},
                         .gap_lengths = {{.between = {ImageId(4), ImageId(5)},
                                          .pairs = 7,
                                          .agreement = {.told = 90.5, .agreeing = 30.25},
                                          .here = 43.5,
                                          .elsewhere = 90.0,
                                          .wall = {.told = 144.5, .agreeing = 59.5},
                                          .scale_jump = 0.75,
                                          .matches = {.told = 582.0, .agreeing = 62.5},
                                          .rays = 369,
                                          .telling_rays = 13,
                                          .is_borne_out = true}},
                         .residual_rms_px = 0.5,
                         .started_globally = true,
                         .start_remark = "29 of 30 images stay registered"}};
  const auto cluster_out = DecodeClusterResult(EncodeClusterResult(cluster).value());
  ASSERT_TRUE(cluster_out.ok()) << cluster_out.status();
  EXPECT_EQ(cluster_out->cluster, 4U);
  EXPECT_EQ(cluster_out->reconstruction.not_registered[0].reason, "no verified matches");
  ASSERT_EQ(cluster_out->reconstruction.parted_pairs.size(), 1U);
  EXPECT_EQ(cluster_out->reconstruction.parted_pairs[0].pair, (ImagePair{ImageId(4), ImageId(9)}));
  EXPECT_EQ(cluster_out->reconstruction.parted_pairs[0].b_from_a.translation,
            Eigen::Vector3d(0.6, 0.0, 0.8));
  EXPECT_EQ(cluster_out->reconstruction.contradicted_pairs,
            (std::vector<ImagePair>{{ImageId(3), ImageId(8)}}));
  ASSERT_EQ(cluster_out->reconstruction.pair_lengths.size(), 1U);
  EXPECT_EQ(cluster_out->reconstruction.pair_lengths[0].pair.b, ImageId(4));
  EXPECT_EQ(cluster_out->reconstruction.pair_lengths[0].agreement.told, 80.5);
  EXPECT_EQ(cluster_out->reconstruction.pair_lengths[0].agreement.agreeing, 20.25);
  ASSERT_EQ(cluster_out->reconstruction.gap_lengths.size(), 1U);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].between,
            (ImagePair{ImageId(4), ImageId(5)}));
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].pairs, 7U);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].agreement.told, 90.5);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].agreement.agreeing, 30.25);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].here, 43.5);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].elsewhere, 90.0);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].wall.told, 144.5);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].wall.agreeing, 59.5);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].scale_jump, 0.75);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].matches.told, 582.0);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].matches.agreeing, 62.5);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].rays, 369U);
  EXPECT_EQ(cluster_out->reconstruction.gap_lengths[0].telling_rays, 13U);
  EXPECT_TRUE(cluster_out->reconstruction.gap_lengths[0].is_borne_out);
  EXPECT_EQ(cluster_out->reconstruction.explained_pairs,
            (std::vector<ImagePair>{{ImageId(3), ImageId(4)}}));
  EXPECT_TRUE(cluster_out->reconstruction.started_globally);
  EXPECT_EQ(cluster_out->reconstruction.start_remark, "29 of 30 images stay registered");
  ExpectSame(cluster_out->reconstruction.submodels[0], cluster.reconstruction.submodels[0]);

  Alignment alignment{
      .world_from_submodel = {Sim3{2.0, Eigen::Quaterniond::Identity(), {1, 2, 3}}, Sim3{}},
      .world = {0, 0},
      .submodels = {{.cluster = 4, .num_images = 7}, {.cluster = 5, .num_images = 6}}};
  alignment.seams.push_back({.submodel_a = 0,
                             .submodel_b = 1,
                             .used = false,
                             .contradicted = true,
                             .drift_factor = 7.5,
                             .reason = "loop",
                             .position_jump_m = 0.1});
  const auto alignment_out = DecodeAlignment(EncodeAlignment(alignment).value());
  ASSERT_TRUE(alignment_out.ok()) << alignment_out.status();
  EXPECT_EQ(alignment_out->world_from_submodel[0].scale, 2.0);
  EXPECT_FALSE(alignment_out->seams[0].used);
  EXPECT_TRUE(alignment_out->seams[0].contradicted);
  EXPECT_EQ(alignment_out->seams[0].drift_factor, 7.5);
  EXPECT_EQ(alignment_out->seams[0].reason, "loop");
  EXPECT_EQ(alignment_out->submodels[0].cluster, 4U);
  EXPECT_EQ(alignment_out->submodels[0].num_images, 7U);

  const PartitionReview review{.rounds = 2, .requests = {{1, 3, 24, "too few"}}};
  const auto review_out = DecodePartitionReview(EncodePartitionReview(review).value());
  ASSERT_TRUE(review_out.ok()) << review_out.status();
  EXPECT_EQ(review_out->rounds, 2U);
  EXPECT_EQ(review_out->requests[0].cluster_a, 1U);
  EXPECT_EQ(review_out->requests[0].cluster_b, 3U);
  EXPECT_EQ(review_out->requests[0].images, 24U);
  EXPECT_EQ(review_out->requests[0].reason, "too few");
  EXPECT_EQ(DecodePartitionReview("")->rounds, 0U);

  FinalisedModel model{.worlds = {{.images = SomeReconstruction().images}},
                       .subproblems = {{DigestOf("block")}}};
  model.worlds[0].report.gnss = {.used = true, .reason = "r", .outliers = {"a.jpg"}};
  model.worlds[0].report.uncertainty = {
      .known = true, .held_image = "b.jpg", .bearing_sigma_factor = 0.9};
  model.worlds[0].report.residual_px_mean = 0.5;
  model.worlds[0].report.weak_images = {{"c.jpg", "8 observations in one corner"}};
  model.left_out = {{"d.jpg", "none of its world is left"}};
  model.worlds[0].report.adjustments.push_back(
      {.iterations = 3, .converged = true, .biases_m = {{1, 2, 3}}});
  const auto model_out = DecodeFinalisedModel(EncodeFinalisedModel(model).value());
  ASSERT_TRUE(model_out.ok()) << model_out.status();
  const GlobalAdjustReport& report = model_out->worlds[0].report;
  EXPECT_EQ(report.gnss.outliers, model.worlds[0].report.gnss.outliers);
  EXPECT_EQ(report.adjustments[0].biases_m[0], Eigen::Vector3d(1, 2, 3));
  ExpectSame({.images = model_out->worlds[0].images}, {.images = model.worlds[0].images});
  ASSERT_EQ(report.weak_images.size(), 1U);
  EXPECT_EQ(report.weak_images[0].name, "c.jpg");
  EXPECT_EQ(report.weak_images[0].reason, "8 observations in one corner");
  EXPECT_EQ(report.uncertainty.held_image, "b.jpg");
  EXPECT_EQ(report.uncertainty.bearing_sigma_factor, 0.9);
  EXPECT_EQ(model_out->subproblems, model.subproblems);
  ASSERT_EQ(model_out->left_out.size(), 1U);
  EXPECT_EQ(model_out->left_out[0].name, "d.jpg");
  EXPECT_EQ(model_out->left_out[0].reason, "none of its world is left");
}

}  // namespace
}  // namespace orbweave
