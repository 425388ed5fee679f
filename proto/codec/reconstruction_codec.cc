// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/reconstruction_codec.h"

#include <algorithm>

#include "proto/codec/crossing_pair_message.h"
#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"
#include "proto/codec/reconstruction_messages.h"

namespace orbweave {

static_assert(sizeof(SubmodelExtent) == 8, "packed as written");

namespace {

absl::Status CheckAgreement(const LengthAgreement& agreement) {
  return codec::Expect(codec::IsAmount(agreement.told) && codec::IsAmount(agreement.agreeing) &&
                           agreement.agreeing <= agreement.told,
                       "cluster reconstruction",
                       "more rays agree with a length than tell it");
}

absl::Status CheckLength(const PairLength& length) {
  ORBWEAVE_RETURN_IF_ERROR(CheckAgreement(length.agreement));
  return codec::Expect(length.pair.a < length.pair.b,
                       "cluster reconstruction",
                       "images of a length are out of order");
}

absl::Status CheckLength(const GapLength& length) {
  ORBWEAVE_RETURN_IF_ERROR(CheckAgreement(length.agreement));
  ORBWEAVE_RETURN_IF_ERROR(CheckAgreement(length.matches));
  ORBWEAVE_RETURN_IF_ERROR(CheckAgreement(length.wall));
  return codec::Expect(length.between.a != length.between.b && codec::IsAmount(length.here) &&
                           codec::IsAmount(length.elsewhere) && codec::IsAmount(length.scale_jump),
                       "cluster reconstruction",
                       "a way leads nowhere, or its rays are no number");
}

absl::StatusOr<std::vector<ImagePair>> UnpackPairs(const std::string& bytes, const char* what) {
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<ImagePair> pairs, codec::Unpack<ImagePair>(bytes, what));
  for (const ImagePair& pair : pairs) {
    if (!(pair.a < pair.b))
      return absl::DataLossError("cluster reconstruction: images of a pair out of order");
  }
  return pairs;
}

}  // namespace

absl::StatusOr<std::string> EncodeReconstruction(const Reconstruction& reconstruction) {
  v1::Reconstruction proto;
  codec::ToProto(reconstruction, &proto);
  return codec::Serialize(proto, "reconstruction", codec::Empty::kIsLegal);
}

absl::StatusOr<Reconstruction> DecodeReconstruction(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::Reconstruction proto,
      codec::Parse<v1::Reconstruction>(bytes, "reconstruction", codec::Empty::kIsLegal));
  return codec::FromProto(proto);
}

absl::StatusOr<std::string> EncodeClusterResult(const ClusterResult& result) {
  v1::ClusterReconstruction proto;
  proto.set_cluster(result.cluster);
  for (const Reconstruction& submodel : result.reconstruction.submodels)
    codec::ToProto(submodel, proto.add_submodels());
  for (const NotRegistered& image : result.reconstruction.not_registered) {
    v1::NotRegistered* out = proto.add_not_registered();
    out->set_image(image.image.value);
    out->set_reason(image.reason);
  }
  for (const ImagePair& pair : result.reconstruction.contradicted_pairs) {
    v1::ContradictedPair* out = proto.add_contradicted_pairs();
    out->set_image_a(pair.a.value);
    out->set_image_b(pair.b.value);
  }
  proto.set_explained_pairs(codec::Pack(result.reconstruction.explained_pairs));
  codec::ToProto(result.reconstruction.parted_pairs, proto.mutable_parted_pairs());
  for (const PairLength& length : result.reconstruction.pair_lengths) {
    v1::PairLength* out = proto.add_pair_lengths();
    out->set_image_a(length.pair.a.value);
    out->set_image_b(length.pair.b.value);
    out->set_told(length.agreement.told);
    out->set_agreeing(length.agreement.agreeing);
  }
  for (const GapLength& length : result.reconstruction.gap_lengths) {
    v1::GapLength* out = proto.add_gap_lengths();
    out->set_image(length.between.a.value);
    out->set_next(length.between.b.value);
    out->set_pairs(length.pairs);
    out->set_told(length.agreement.told);
    out->set_agreeing(length.agreement.agreeing);
    out->set_here(length.here);
    out->set_elsewhere(length.elsewhere);
    out->set_wall(length.wall.told);
    out->set_agreeing_wall(length.wall.agreeing);
    out->set_scale_jump(length.scale_jump);
    out->set_matches(length.matches.told);
    out->set_agreeing_matches(length.matches.agreeing);
    out->set_rays(length.rays);
    out->set_telling_rays(length.telling_rays);
    out->set_is_borne_out(length.is_borne_out);
  }
  proto.set_num_global_adjustments(result.reconstruction.num_global_adjustments);
  proto.set_num_local_adjustments(result.reconstruction.num_local_adjustments);
  proto.set_residual_rms_px(result.reconstruction.residual_rms_px);
  proto.set_started_globally(result.reconstruction.started_globally);
  proto.set_start_remark(result.reconstruction.start_remark);
  return codec::Serialize(proto, "cluster reconstruction", codec::Empty::kIsLegal);
}

absl::StatusOr<ClusterResult> DecodeClusterResult(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::ClusterReconstruction proto,
                            codec::Parse<v1::ClusterReconstruction>(
                                bytes, "cluster reconstruction", codec::Empty::kIsLegal));
  ClusterResult result{.cluster = proto.cluster()};
  for (const v1::Reconstruction& submodel : proto.submodels()) {
    ORBWEAVE_ASSIGN_OR_RETURN(Reconstruction decoded, codec::FromProto(submodel));
    result.reconstruction.submodels.push_back(std::move(decoded));
  }
  for (const v1::NotRegistered& image : proto.not_registered()) {
    result.reconstruction.not_registered.push_back({ImageId(image.image()), image.reason()});
  }
  for (const v1::ContradictedPair& pair : proto.contradicted_pairs()) {
    if (pair.image_a() >= pair.image_b())
      return absl::DataLossError("cluster reconstruction: images of a pair out of order");
    result.reconstruction.contradicted_pairs.push_back(
        {ImageId(pair.image_a()), ImageId(pair.image_b())});
  }
  ORBWEAVE_ASSIGN_OR_RETURN(result.reconstruction.explained_pairs,
                            UnpackPairs(proto.explained_pairs(), "explained pairs"));
  ORBWEAVE_ASSIGN_OR_RETURN(result.reconstruction.parted_pairs,
                            codec::FromProto(proto.parted_pairs()));
  for (const v1::PairLength& length : proto.pair_lengths()) {
    result.reconstruction.pair_lengths.push_back(
        {.pair = {ImageId(length.image_a()), ImageId(length.image_b())},
         .agreement = {.told = length.told(), .agreeing = length.agreeing()}});
    ORBWEAVE_RETURN_IF_ERROR(CheckLength(result.reconstruction.pair_lengths.back()));
  }
  for (const v1::GapLength& length : proto.gap_lengths()) {
    result.reconstruction.gap_lengths.push_back(
        {.between = {ImageId(length.image()), ImageId(length.next())},
         .pairs = length.pairs(),
         .agreement = {.told = length.told(), .agreeing = length.agreeing()},
         .here = length.here(),
         .elsewhere = length.elsewhere(),
         .wall = {.told = length.wall(), .agreeing = length.agreeing_wall()},
         .scale_jump = length.scale_jump(),
         .matches = {.told = length.matches(), .agreeing = length.agreeing_matches()},
         .rays = length.rays(),
         .telling_rays = length.telling_rays(),
         .is_borne_out = length.is_borne_out()});
    ORBWEAVE_RETURN_IF_ERROR(CheckLength(result.reconstruction.gap_lengths.back()));
  }
  result.reconstruction.num_global_adjustments = proto.num_global_adjustments();
  result.reconstruction.num_local_adjustments = proto.num_local_adjustments();
  result.reconstruction.residual_rms_px = proto.residual_rms_px();
  result.reconstruction.started_globally = proto.started_globally();
  result.reconstruction.start_remark = proto.start_remark();
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(codec::IsAmount(result.reconstruction.residual_rms_px) &&
                                             result.reconstruction.num_global_adjustments >= 0 &&
                                             result.reconstruction.num_local_adjustments >= 0,
                                         "cluster reconstruction",
                                         "a residual or a count is none"));
  return result;
}

absl::StatusOr<std::string> EncodeAlignment(const Alignment& alignment) {
  v1::Alignment proto;
  for (const Sim3& sim : alignment.world_from_submodel)
    codec::ToProto(sim, proto.add_world_from_submodel());
  for (const uint32_t world : alignment.world) proto.add_world(world);
  for (const SeamReport& seam : alignment.seams) {
    v1::SeamReport* out = proto.add_seams();
    out->set_submodel_a(seam.submodel_a);
    out->set_submodel_b(seam.submodel_b);
    out->set_common_images(seam.common_images);
    out->set_common_tracks(seam.common_tracks);
    out->set_inlier_tracks(seam.inlier_tracks);
    out->set_condition_number(seam.condition_number);
    out->set_used(seam.used);
    out->set_reason(seam.reason);
    out->set_position_jump_m(seam.position_jump_m);
    out->set_rotation_jump_deg(seam.rotation_jump_deg);
    out->set_contradicted(seam.contradicted);
    out->set_drift_factor(seam.drift_factor);
  }
  proto.set_submodels(codec::Pack(alignment.submodels));
  return codec::Serialize(proto, "alignment", codec::Empty::kIsLegal);
}

namespace {

/// A condition of infinity is one that nobody used.
bool IsSeamOf(const SeamReport& seam, size_t num_submodels) {
  return seam.submodel_a < seam.submodel_b && seam.submodel_b < num_submodels &&
         seam.condition_number >= 0.0 && seam.drift_factor >= 1.0 &&
         codec::IsAmount(seam.drift_factor) && codec::IsAmount(seam.position_jump_m) &&
         codec::IsAmount(seam.rotation_jump_deg);
}

absl::Status CheckAlignment(const Alignment& alignment) {
  const size_t count = alignment.world.size();
  const auto is_world = [count](uint32_t world) { return world < count; };
  const auto is_seam = [count](const SeamReport& seam) { return IsSeamOf(seam, count); };
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      std::ranges::all_of(alignment.world, is_world), "alignment", "more worlds than submodels"));
  return codec::Expect(std::ranges::all_of(alignment.seams, is_seam),
                       "alignment",
                       "a seam of no submodels, or of no numbers");
}

bool IsRequest(const OverlapRequest& request) { return request.cluster_a < request.cluster_b; }

}  // namespace

absl::StatusOr<Alignment> DecodeAlignment(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::Alignment proto,
      codec::Parse<v1::Alignment>(bytes, "alignment", codec::Empty::kIsLegal));
  Alignment alignment;
  for (const v1::Sim3& sim : proto.world_from_submodel()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Sim3 decoded, codec::PlacementFromProto(sim));
    alignment.world_from_submodel.push_back(decoded);
  }
  alignment.world.assign(proto.world().begin(), proto.world().end());
  if (alignment.world.size() != alignment.world_from_submodel.size()) {
    return absl::DataLossError("alignment: one world per submodel");
  }
  ORBWEAVE_ASSIGN_OR_RETURN(
      alignment.submodels,
      codec::UnpackExactly<SubmodelExtent>(proto.submodels(), alignment.world.size(), "submodels"));
  for (const v1::SeamReport& seam : proto.seams()) {
    alignment.seams.push_back({.submodel_a = seam.submodel_a(),
                               .submodel_b = seam.submodel_b(),
                               .common_images = seam.common_images(),
                               .common_tracks = seam.common_tracks(),
                               .inlier_tracks = seam.inlier_tracks(),
                               .condition_number = seam.condition_number(),
                               .used = seam.used(),
                               .contradicted = seam.contradicted(),
                               .drift_factor = seam.drift_factor(),
                               .reason = seam.reason(),
                               .position_jump_m = seam.position_jump_m(),
                               .rotation_jump_deg = seam.rotation_jump_deg()});
  }
  ORBWEAVE_RETURN_IF_ERROR(CheckAlignment(alignment));
  return alignment;
}

absl::StatusOr<std::string> EncodePartitionReview(const PartitionReview& review) {
  v1::PartitionReview proto;
  proto.set_rounds(review.rounds);
  for (const OverlapRequest& request : review.requests) {
    v1::OverlapRequest* out = proto.add_requests();
    out->set_cluster_a(request.cluster_a);
    out->set_cluster_b(request.cluster_b);
    out->set_images(request.images);
    out->set_reason(request.reason);
  }
  return codec::Serialize(proto, "partition review", codec::Empty::kIsLegal);
}

absl::StatusOr<PartitionReview> DecodePartitionReview(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::PartitionReview proto,
      codec::Parse<v1::PartitionReview>(bytes, "partition review", codec::Empty::kIsLegal));
  PartitionReview review{.rounds = proto.rounds()};
  for (const v1::OverlapRequest& request : proto.requests()) {
    review.requests.push_back(
        {request.cluster_a(), request.cluster_b(), request.images(), request.reason()});
  }
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(std::ranges::all_of(review.requests, IsRequest),
                                         "partition review",
                                         "a request is not for two clusters"));
  return review;
}

}  // namespace orbweave
