// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/reconstruction_codec.h"

#include <array>

#include "proto/codec/pack.h"

namespace orbweave {
namespace {

using Vector3Bytes = std::array<double, 3>;
using PoseBytes = std::array<double, 7>;

Vector3Bytes ToArray(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d ToVector(const Vector3Bytes& a) { return {a[0], a[1], a[2]}; }

absl::StatusOr<Rigid3> ToPose(const PoseBytes& a) {
  const Rigid3 pose{Eigen::Quaterniond(a[0], a[1], a[2], a[3]), Eigen::Vector3d(a[4], a[5], a[6])};
  if (!pose.translation.allFinite() || !(std::abs(pose.rotation.norm() - 1.0) < 1e-6)) {
    return absl::InvalidArgumentError("reconstruction: a pose is not a rigid motion");
  }
  return pose;
}

void ImagesToProto(const Reconstruction& reconstruction, v1::Reconstruction* proto) {
  std::vector<ImageId> ids;
  std::vector<PoseBytes> poses;
  std::vector<uint8_t> loose;
  for (const auto& [id, image] : reconstruction.images) {
    const Rigid3& pose = image.cam_from_world;
    const Eigen::Quaterniond& q = pose.rotation;
    const Eigen::Vector3d& t = pose.translation;
    ids.push_back(id);
    poses.push_back({q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()});
    loose.push_back(image.loose ? 1 : 0);
  }
  proto->set_image_ids(codec::Pack(ids));
  proto->set_cams_from_world(codec::Pack(poses));
  proto->set_loose(codec::Pack(loose));
}

void TracksToProto(const Reconstruction& reconstruction, v1::Reconstruction* proto) {
  std::vector<Vector3Bytes> points;
  std::vector<Vector3Bytes> bearings;
  std::vector<Rgb> colors;
  std::vector<uint32_t> lengths;
  std::vector<uint32_t> images;
  std::vector<uint32_t> features;
  std::vector<double> sigmas;
  for (const Track& track : reconstruction.tracks) {
    points.push_back(ToArray(track.point_in_world));
    colors.push_back(track.color);
    lengths.push_back(static_cast<uint32_t>(track.observations.size()));
    for (const Observation& observation : track.observations) {
      images.push_back(observation.ref.image.value);
      features.push_back(observation.ref.feature);
      bearings.push_back(ToArray(observation.bearing));
      sigmas.push_back(observation.sigma_rad);
    }
  }
  proto->set_points(codec::Pack(points));
  proto->set_colors(codec::Pack(colors));
  proto->set_track_lengths(codec::Pack(lengths));
  proto->set_observation_images(codec::Pack(images));
  proto->set_observation_features(codec::Pack(features));
  proto->set_bearings(codec::Pack(bearings));
  proto->set_sigmas_rad(codec::Pack(sigmas));
}

absl::Status ImagesFromProto(const v1::Reconstruction& proto, Reconstruction& reconstruction) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto ids, codec::Unpack<ImageId>(proto.image_ids(), "images"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto poses,
      codec::UnpackExactly<PoseBytes>(proto.cams_from_world(), ids.size(), "poses"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto loose,
                            codec::UnpackExactly<uint8_t>(proto.loose(), ids.size(), "flags"));
  for (size_t i = 0; i < ids.size(); ++i) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Rigid3 pose, ToPose(poses[i]));
    reconstruction.images[ids[i]] = {pose, loose[i] != 0};
  }
  return absl::OkStatus();
}

absl::Status TracksFromProto(const v1::Reconstruction& proto, Reconstruction& reconstruction) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto lengths,
                            codec::Unpack<uint32_t>(proto.track_lengths(), "track lengths"));
  const size_t num_tracks = lengths.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto points, codec::UnpackExactly<Vector3Bytes>(proto.points(), num_tracks, "points"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto colors,
                            codec::UnpackExactly<Rgb>(proto.colors(), num_tracks, "colours"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images,
                            codec::Unpack<ImageId>(proto.observation_images(), "observations"));
  const size_t num_observations = images.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto features,
      codec::UnpackExactly<uint32_t>(
          proto.observation_features(), num_observations, "observed features"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto bearings,
      codec::UnpackExactly<Vector3Bytes>(proto.bearings(), num_observations, "bearings"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto sigmas,
      codec::UnpackExactly<double>(proto.sigmas_rad(), num_observations, "sigmas"));
  size_t next = 0;
  reconstruction.tracks.resize(num_tracks);
  for (size_t i = 0; i < num_tracks; ++i) {
    Track& track = reconstruction.tracks[i];
    track.point_in_world = ToVector(points[i]);
    track.color = colors[i];
    if (lengths[i] == 0 || lengths[i] > num_observations - next) {
      return absl::InvalidArgumentError(
          "reconstruction: track lengths do not match the observations");
    }
    for (const size_t end = next + lengths[i]; next < end; ++next) {
      const Eigen::Vector3d bearing = ToVector(bearings[next]);
      if (!(std::abs(bearing.norm() - 1.0) < 1e-6)) {
        return absl::InvalidArgumentError("reconstruction: a bearing is not a unit vector");
      }
      if (!reconstruction.images.contains(images[next])) {
        return absl::InvalidArgumentError(
            "reconstruction: an observation of an image that is not registered");
      }
      track.observations.push_back({{images[next], features[next]}, bearing, sigmas[next]});
    }
  }
  if (next != num_observations)
    return absl::InvalidArgumentError("reconstruction: observations without a track");
  return absl::OkStatus();
}

void ToProto(const Reconstruction& reconstruction, v1::Reconstruction* proto) {
  ImagesToProto(reconstruction, proto);
  TracksToProto(reconstruction, proto);
}

absl::StatusOr<Reconstruction> FromProto(const v1::Reconstruction& proto) {
  Reconstruction reconstruction;
  ORBWEAVE_RETURN_IF_ERROR(ImagesFromProto(proto, reconstruction));
  ORBWEAVE_RETURN_IF_ERROR(TracksFromProto(proto, reconstruction));
  return reconstruction;
}

}  // namespace

std::string EncodeReconstruction(const Reconstruction& reconstruction) {
  v1::Reconstruction proto;
  ToProto(reconstruction, &proto);
  return proto.SerializeAsString();
}

absl::StatusOr<Reconstruction> DecodeReconstruction(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::Reconstruction proto,
                            codec::Parse<v1::Reconstruction>(bytes, "reconstruction"));
  return FromProto(proto);
}

std::string EncodeClusterResult(const ClusterResult& result) {
  v1::ClusterReconstruction proto;
  proto.set_cluster(result.cluster);
  for (const Reconstruction& component : result.reconstruction.components)
    ToProto(component, proto.add_components());
  for (const NotRegistered& image : result.reconstruction.not_registered) {
    v1::NotRegistered* out = proto.add_not_registered();
    out->set_image(image.image.value);
    out->set_reason(image.reason);
  }
  proto.set_num_global_adjustments(result.reconstruction.num_global_adjustments);
  proto.set_num_local_adjustments(result.reconstruction.num_local_adjustments);
  proto.set_residual_rms_px(result.reconstruction.residual_rms_px);
  return proto.SerializeAsString();
}

absl::StatusOr<ClusterResult> DecodeClusterResult(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::ClusterReconstruction proto,
      codec::Parse<v1::ClusterReconstruction>(bytes, "cluster reconstruction"));
  ClusterResult result{.cluster = proto.cluster()};
  for (const v1::Reconstruction& component : proto.components()) {
    ORBWEAVE_ASSIGN_OR_RETURN(Reconstruction decoded, FromProto(component));
    result.reconstruction.components.push_back(std::move(decoded));
  }
  for (const v1::NotRegistered& image : proto.not_registered()) {
    result.reconstruction.not_registered.push_back({ImageId(image.image()), image.reason()});
  }
  result.reconstruction.num_global_adjustments = proto.num_global_adjustments();
  result.reconstruction.num_local_adjustments = proto.num_local_adjustments();
  result.reconstruction.residual_rms_px = proto.residual_rms_px();
  return result;
}

std::string EncodeAlignment(const Alignment& alignment) {
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
  }
  return proto.SerializeAsString();
}

absl::StatusOr<Alignment> DecodeAlignment(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::Alignment proto,
                            codec::Parse<v1::Alignment>(bytes, "alignment"));
  Alignment alignment;
  for (const v1::Sim3& sim : proto.world_from_submodel()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Sim3 decoded, codec::FromProto(sim));
    alignment.world_from_submodel.push_back(decoded);
  }
  alignment.world.assign(proto.world().begin(), proto.world().end());
  if (alignment.world.size() != alignment.world_from_submodel.size()) {
    return absl::InvalidArgumentError("alignment: one world per submodel");
  }
  for (const v1::SeamReport& seam : proto.seams()) {
    alignment.seams.push_back({.submodel_a = seam.submodel_a(),
                               .submodel_b = seam.submodel_b(),
                               .common_images = seam.common_images(),
                               .common_tracks = seam.common_tracks(),
                               .inlier_tracks = seam.inlier_tracks(),
                               .condition_number = seam.condition_number(),
                               .used = seam.used(),
                               .reason = seam.reason(),
                               .position_jump_m = seam.position_jump_m(),
                               .rotation_jump_deg = seam.rotation_jump_deg()});
  }
  return alignment;
}

std::string EncodeMergedWorlds(const std::vector<MergedWorld>& worlds) {
  v1::MergedWorlds proto;
  for (const MergedWorld& world : worlds) {
    v1::MergedWorld* out = proto.add_worlds();
    ToProto(world.reconstruction, out->mutable_reconstruction());
    out->set_united_tracks(world.report.united_tracks);
    out->set_conflicting_tracks(world.report.conflicting_tracks);
  }
  return proto.SerializeAsString();
}

absl::StatusOr<std::vector<MergedWorld>> DecodeMergedWorlds(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::MergedWorlds proto,
                            codec::Parse<v1::MergedWorlds>(bytes, "merged worlds"));
  std::vector<MergedWorld> worlds;
  for (const v1::MergedWorld& world : proto.worlds()) {
    ORBWEAVE_ASSIGN_OR_RETURN(Reconstruction reconstruction, FromProto(world.reconstruction()));
    worlds.push_back(
        {std::move(reconstruction), {world.united_tracks(), world.conflicting_tracks()}});
  }
  return worlds;
}

namespace {

void ToProto(const GnssReport& gnss, v1::GnssReport* proto) {
  proto->set_used(gnss.used);
  proto->set_reason(gnss.reason);
  proto->set_num_priors(gnss.num_priors);
  proto->set_num_inliers(gnss.num_inliers);
  proto->set_residual_median_m(gnss.residual_median_m);
  proto->set_residual_rms_inliers_m(gnss.residual_rms_inliers_m);
  for (const std::string& name : gnss.outliers) proto->add_outliers(name);
}

GnssReport FromProto(const v1::GnssReport& proto) {
  return {.used = proto.used(),
          .reason = proto.reason(),
          .num_priors = proto.num_priors(),
          .num_inliers = proto.num_inliers(),
          .residual_median_m = proto.residual_median_m(),
          .residual_rms_inliers_m = proto.residual_rms_inliers_m(),
          .outliers = {proto.outliers().begin(), proto.outliers().end()}};
}

void ToProto(const BundleReport& report, v1::BundleReport* proto) {
  proto->set_initial_cost(report.initial_cost);
  proto->set_final_cost(report.final_cost);
  proto->set_iterations(report.iterations);
  proto->set_converged(report.converged);
  std::vector<Vector3Bytes> biases;
  for (const Eigen::Vector3d& bias : report.biases_m) biases.push_back(ToArray(bias));
  proto->set_biases_m(codec::Pack(biases));
}

absl::StatusOr<BundleReport> FromProto(const v1::BundleReport& proto) {
  BundleReport report{.initial_cost = proto.initial_cost(),
                      .final_cost = proto.final_cost(),
                      .iterations = proto.iterations(),
                      .converged = proto.converged()};
  ORBWEAVE_ASSIGN_OR_RETURN(const auto biases,
                            codec::Unpack<Vector3Bytes>(proto.biases_m(), "biases"));
  for (const Vector3Bytes& bias : biases) report.biases_m.push_back(ToVector(bias));
  return report;
}

absl::StatusOr<GloballyAdjusted> FromProto(const v1::AdjustedWorld& proto) {
  GloballyAdjusted world;
  ORBWEAVE_ASSIGN_OR_RETURN(world.reconstruction, FromProto(proto.reconstruction()));
  world.report.gnss = FromProto(proto.gnss());
  for (const v1::BundleReport& report : proto.adjustments()) {
    ORBWEAVE_ASSIGN_OR_RETURN(BundleReport adjustment, FromProto(report));
    world.report.adjustments.push_back(std::move(adjustment));
  }
  world.report.removed_observations = proto.removed_observations();
  world.report.removed_tracks = proto.removed_tracks();
  world.report.residual_px_mean = proto.residual_px_mean();
  world.report.residual_px_rms = proto.residual_px_rms();
  return world;
}

}  // namespace

std::string EncodeAdjustedWorlds(const std::vector<GloballyAdjusted>& worlds) {
  v1::AdjustedWorlds proto;
  for (const GloballyAdjusted& world : worlds) {
    v1::AdjustedWorld* out = proto.add_worlds();
    ToProto(world.reconstruction, out->mutable_reconstruction());
    ToProto(world.report.gnss, out->mutable_gnss());
    for (const BundleReport& report : world.report.adjustments)
      ToProto(report, out->add_adjustments());
    out->set_removed_observations(world.report.removed_observations);
    out->set_removed_tracks(world.report.removed_tracks);
    out->set_residual_px_mean(world.report.residual_px_mean);
    out->set_residual_px_rms(world.report.residual_px_rms);
  }
  return proto.SerializeAsString();
}

absl::StatusOr<std::vector<GloballyAdjusted>> DecodeAdjustedWorlds(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::AdjustedWorlds proto,
                            codec::Parse<v1::AdjustedWorlds>(bytes, "adjusted worlds"));
  std::vector<GloballyAdjusted> worlds;
  for (const v1::AdjustedWorld& world : proto.worlds()) {
    ORBWEAVE_ASSIGN_OR_RETURN(GloballyAdjusted decoded, FromProto(world));
    worlds.push_back(std::move(decoded));
  }
  return worlds;
}

}  // namespace orbweave
