// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/seams_codec.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"

namespace orbweave {
namespace {

using SharedPose = FittedSeam::SharedPose;

static_assert(sizeof(SubmodelName) == 8 && sizeof(ImageId) == 4, "packed as written");

void ToProto(const SubmodelOutline& outline, v1::SubmodelOutline* proto) {
  proto->set_cluster(outline.name.cluster);
  proto->set_submodel(outline.name.submodel);
  proto->set_images(codec::Pack(outline.images));
  proto->set_length(outline.length);
  if (!outline.level) return;
  codec::ToProto(outline.level->up, proto->mutable_up());
  proto->set_up_sigma_rad(outline.level->sigma_rad);
}

absl::StatusOr<SubmodelOutline> FromProto(const v1::SubmodelOutline& proto) {
  SubmodelOutline outline{.name = {proto.cluster(), proto.submodel()}, .length = proto.length()};
  ORBWEAVE_ASSIGN_OR_RETURN(outline.images, codec::Unpack<ImageId>(proto.images(), "images"));
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::Ascends(outline.images), "seams", "images are not in order"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(outline.length > 0.0 && codec::IsLength(outline.length),
                                         "seams",
                                         "a submodel has no length"));
  if (!proto.has_up()) return outline;
  outline.level = SubmodelLevel{codec::FromProto(proto.up()), proto.up_sigma_rad()};
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      codec::IsDirection(outline.level->up) && codec::IsSigma(outline.level->sigma_rad),
      "seams",
      "what is up in a submodel is no direction"));
  return outline;
}

void ToProto(const SeamFit& fit, v1::FittedSeam* proto) {
  codec::ToProto(fit.chart.a_from_b, proto->mutable_a_from_b());
  codec::ToProto(fit.chart.anchor_in_b, proto->mutable_anchor_in_b());
  proto->set_length_in_a(fit.chart.length_in_a);
  proto->set_covariance(
      codec::Pack(std::vector<double>(fit.covariance.data(), fit.covariance.data() + 49)));
  proto->set_condition_number(fit.condition_number);
  proto->set_inlier_tracks(fit.inlier_tracks);
  proto->set_inlier_cameras(fit.inlier_cameras);
}

/// A similarity that the evidence leaves open has a condition of up to infinity, and nobody looks
/// at its covariance.
absl::Status CheckFit(const SeamFit& fit) {
  using codec::Expect;
  constexpr double kWorstCondition = 1e9;
  const Matrix7d& C = fit.covariance;
  ORBWEAVE_RETURN_IF_ERROR(Expect(codec::AreNumbers(fit.chart.anchor_in_b) &&
                                      fit.chart.length_in_a > 0.0 &&
                                      codec::IsNumber(fit.chart.length_in_a),
                                  "seam",
                                  "its chart is none"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(fit.condition_number >= 0.0, "seam", "its condition is no number"));
  if (fit.condition_number > kWorstCondition) return absl::OkStatus();
  ORBWEAVE_RETURN_IF_ERROR(Expect(codec::AreNumbers(C) &&
                                      (C - C.transpose()).norm() <= 1e-6 * C.norm() &&
                                      (C.diagonal().array() > 0.0).all(),
                                  "seam",
                                  "its covariance is none"));
  return absl::OkStatus();
}

absl::StatusOr<SeamFit> FitFromProto(const v1::FittedSeam& proto) {
  SeamFit fit{.condition_number = proto.condition_number(),
              .inlier_tracks = proto.inlier_tracks(),
              .inlier_cameras = proto.inlier_cameras()};
  ORBWEAVE_ASSIGN_OR_RETURN(fit.chart.a_from_b, codec::FromProto(proto.a_from_b()));
  fit.chart.anchor_in_b = codec::FromProto(proto.anchor_in_b());
  fit.chart.length_in_a = proto.length_in_a();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<double> covariance,
                            codec::UnpackExactly<double>(proto.covariance(), 49, "covariance"));
  fit.covariance = Eigen::Map<const Matrix7d>(covariance.data());
  ORBWEAVE_RETURN_IF_ERROR(CheckFit(fit));
  return fit;
}

void ToProto(const FittedSeam& seam, v1::FittedSeam* proto) {
  proto->set_submodels(codec::Pack(std::vector{seam.a, seam.b}));
  proto->set_common_tracks(seam.common_tracks);
  for (const SharedPose& shared : seam.shared) {
    codec::ToProto(shared.cam_from_a, proto->add_cams_from_a());
    codec::ToProto(shared.cam_from_b, proto->add_cams_from_b());
  }
  ToProto(seam.fit, proto);
  proto->set_extent_a(seam.extent_a);
  proto->set_extent_b(seam.extent_b);
}

absl::StatusOr<std::vector<SharedPose>> SharedFromProto(const v1::FittedSeam& proto) {
  if (proto.cams_from_a_size() != proto.cams_from_b_size())
    return absl::DataLossError("seam: shared images need a pose on both sides");
  std::vector<SharedPose> shared;
  for (int i = 0; i < proto.cams_from_a_size(); ++i) {
    SharedPose& pose = shared.emplace_back();
    ORBWEAVE_ASSIGN_OR_RETURN(pose.cam_from_a, codec::FromProto(proto.cams_from_a(i)));
    ORBWEAVE_ASSIGN_OR_RETURN(pose.cam_from_b, codec::FromProto(proto.cams_from_b(i)));
  }
  return shared;
}

absl::StatusOr<FittedSeam> FromProto(const v1::FittedSeam& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<SubmodelName> names,
                            codec::UnpackExactly<SubmodelName>(proto.submodels(), 2, "submodels"));
  FittedSeam seam{.a = names[0],
                  .b = names[1],
                  .common_tracks = proto.common_tracks(),
                  .extent_a = proto.extent_a(),
                  .extent_b = proto.extent_b()};
  ORBWEAVE_ASSIGN_OR_RETURN(seam.shared, SharedFromProto(proto));
  ORBWEAVE_ASSIGN_OR_RETURN(seam.fit, FitFromProto(proto));
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(seam.a < seam.b, "seam", "it is not between two submodels in order"));
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::IsAmount(seam.extent_a) && codec::IsAmount(seam.extent_b),
                    "seam",
                    "an extent is none"));
  return seam;
}

}  // namespace

absl::StatusOr<std::string> EncodeSeamsOfCluster(const SeamsOfCluster& seams) {
  v1::SeamsOfCluster proto;
  for (const SubmodelOutline& outline : seams.submodels) ToProto(outline, proto.add_submodels());
  for (const FittedSeam& seam : seams.seams) ToProto(seam, proto.add_seams());
  return codec::Serialize(proto, "seams", codec::Empty::kIsLegal);
}

absl::StatusOr<SeamsOfCluster> DecodeSeamsOfCluster(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::SeamsOfCluster proto,
      codec::Parse<v1::SeamsOfCluster>(bytes, "seams", codec::Empty::kIsLegal));
  SeamsOfCluster seams;
  for (const v1::SubmodelOutline& outline : proto.submodels()) {
    ORBWEAVE_ASSIGN_OR_RETURN(seams.submodels.emplace_back(), FromProto(outline));
  }
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(codec::Ascends(seams.submodels, &SubmodelOutline::name),
                                         "seams",
                                         "submodels are not in order"));
  for (const v1::FittedSeam& seam : proto.seams()) {
    ORBWEAVE_ASSIGN_OR_RETURN(seams.seams.emplace_back(), FromProto(seam));
  }
  return seams;
}

}  // namespace orbweave
