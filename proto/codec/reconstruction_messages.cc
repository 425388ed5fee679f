// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/reconstruction_messages.h"

#include <algorithm>

#include "proto/codec/plausible.h"

namespace orbweave::codec {
namespace {

absl::StatusOr<Rigid3> ToPose(const PoseBytes& a) {
  const Rigid3 pose{Eigen::Quaterniond(a[0], a[1], a[2], a[3]), Eigen::Vector3d(a[4], a[5], a[6])};
  if (!IsPlace(pose.translation) || !(std::abs(pose.rotation.norm() - 1.0) < 1e-6)) {
    return absl::DataLossError("reconstruction: a pose is not a rigid motion, or leads nowhere");
  }
  return pose;
}

using UncertaintyBytes = std::array<double, 7>;

UncertaintyBytes PackUncertainty(const PoseUncertainty& uncertainty) {
  const Eigen::Matrix3d& C = uncertainty.position_covariance;
  return {C(0, 0), C(1, 1), C(2, 2), C(0, 1), C(0, 2), C(1, 2), uncertainty.rotation_sigma_rad};
}

absl::StatusOr<PoseUncertainty> ToUncertainty(const UncertaintyBytes& a) {
  PoseUncertainty uncertainty{.rotation_sigma_rad = a[6]};
  uncertainty.position_covariance << a[0], a[3], a[4], a[3], a[1], a[5], a[4], a[5], a[2];
  if (!AreNumbers(uncertainty.position_covariance) || !IsAmount(a[6])) {
    return absl::DataLossError("reconstruction: an uncertainty is not a number");
  }
  return uncertainty;
}

void ImagesToProto(const Reconstruction& reconstruction, v1::Reconstruction* proto) {
  std::vector<ImageId> ids;
  std::vector<PoseBytes> poses;
  std::vector<uint8_t> loose;
  std::vector<ImageId> uncertain;
  std::vector<UncertaintyBytes> uncertainties;
  for (const auto& [id, image] : reconstruction.images) {
    const Rigid3& pose = image.cam_from_world;
    const Eigen::Quaterniond& q = pose.rotation;
    const Eigen::Vector3d& t = pose.translation;
    ids.push_back(id);
    poses.push_back({q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()});
    loose.push_back(image.loose ? 1 : 0);
    if (!image.uncertainty) continue;
    uncertain.push_back(id);
    uncertainties.push_back(PackUncertainty(*image.uncertainty));
  }
  proto->set_image_ids(Pack(ids));
  proto->set_cams_from_world(Pack(poses));
  proto->set_loose(Pack(loose));
  proto->set_uncertain_images(Pack(uncertain));
  proto->set_uncertainties(Pack(uncertainties));
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
  proto->set_points(Pack(points));
  proto->set_colors(Pack(colors));
  proto->set_track_lengths(Pack(lengths));
  proto->set_observation_images(Pack(images));
  proto->set_observation_features(Pack(features));
  proto->set_bearings(Pack(bearings));
  proto->set_sigmas_rad(Pack(sigmas));
}

absl::Status ImagesFromProto(const v1::Reconstruction& proto, Reconstruction& reconstruction) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto ids, Unpack<ImageId>(proto.image_ids(), "images"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto poses,
                            UnpackExactly<PoseBytes>(proto.cams_from_world(), ids.size(), "poses"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto loose,
                            UnpackExactly<uint8_t>(proto.loose(), ids.size(), "flags"));
  ORBWEAVE_RETURN_IF_ERROR(Expect(Ascends(ids), "reconstruction", "images are not in order"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(AreFlags(loose, 1), "reconstruction", "an image is neither loose nor not"));
  for (size_t i = 0; i < ids.size(); ++i) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Rigid3 pose, ToPose(poses[i]));
    reconstruction.images[ids[i]] = {.cam_from_world = pose, .loose = loose[i] != 0};
  }
  return absl::OkStatus();
}

absl::Status UncertaintiesFromProto(const v1::Reconstruction& proto,
                                    Reconstruction& reconstruction) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto ids,
                            Unpack<ImageId>(proto.uncertain_images(), "uncertain images"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto uncertainties,
      UnpackExactly<UncertaintyBytes>(proto.uncertainties(), ids.size(), "uncertainties"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(Ascends(ids), "reconstruction", "uncertainties are not in order"));
  for (size_t i = 0; i < ids.size(); ++i) {
    const auto image = reconstruction.images.find(ids[i]);
    if (image == reconstruction.images.end()) {
      return absl::DataLossError(
          "reconstruction: the uncertainty of an image that is not registered");
    }
    ORBWEAVE_ASSIGN_OR_RETURN(image->second.uncertainty, ToUncertainty(uncertainties[i]));
  }
  return absl::OkStatus();
}

absl::Status TracksFromProto(const v1::Reconstruction& proto, Reconstruction& reconstruction) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto lengths,
                            Unpack<uint32_t>(proto.track_lengths(), "track lengths"));
  const size_t num_tracks = lengths.size();
  ORBWEAVE_ASSIGN_OR_RETURN(const auto points,
                            UnpackExactly<Vector3Bytes>(proto.points(), num_tracks, "points"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto colors,
                            UnpackExactly<Rgb>(proto.colors(), num_tracks, "colours"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images,
                            Unpack<ImageId>(proto.observation_images(), "observations"));
  const size_t num_observations = images.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto features,
      UnpackExactly<uint32_t>(proto.observation_features(), num_observations, "observed features"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto bearings,
      UnpackExactly<Vector3Bytes>(proto.bearings(), num_observations, "bearings"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto sigmas,
                            UnpackExactly<double>(proto.sigmas_rad(), num_observations, "sigmas"));
  size_t next = 0;
  reconstruction.tracks.resize(num_tracks);
  for (size_t i = 0; i < num_tracks; ++i) {
    Track& track = reconstruction.tracks[i];
    track.point_in_world = ToVector(points[i]);
    track.color = colors[i];
    ORBWEAVE_RETURN_IF_ERROR(
        Expect(IsPoint(track.point_in_world), "reconstruction", "a point is nowhere"));
    if (lengths[i] == 0 || lengths[i] > num_observations - next) {
      return absl::DataLossError("reconstruction: track lengths do not match the observations");
    }
    for (const size_t end = next + lengths[i]; next < end; ++next) {
      const Eigen::Vector3d bearing = ToVector(bearings[next]);
      ORBWEAVE_RETURN_IF_ERROR(
          Expect(IsDirection(bearing), "reconstruction", "a bearing is not a unit vector"));
      ORBWEAVE_RETURN_IF_ERROR(
          Expect(IsSigma(sigmas[next]), "reconstruction", "a sigma is not positive"));
      if (!reconstruction.images.contains(images[next])) {
        return absl::DataLossError(
            "reconstruction: an observation of an image that is not registered");
      }
      track.observations.push_back({{images[next], features[next]}, bearing, sigmas[next]});
    }
  }
  if (next != num_observations)
    return absl::DataLossError("reconstruction: observations without a track");
  return absl::OkStatus();
}

}  // namespace

std::string PackVectors(const std::vector<Eigen::Vector3d>& vectors) {
  std::vector<Vector3Bytes> arrays;
  arrays.reserve(vectors.size());
  for (const Eigen::Vector3d& vector : vectors) arrays.push_back(ToArray(vector));
  return Pack(arrays);
}

absl::StatusOr<std::vector<Eigen::Vector3d>> UnpackVectors(const std::string& bytes,
                                                           const char* what) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto arrays, Unpack<Vector3Bytes>(bytes, what));
  std::vector<Eigen::Vector3d> vectors;
  vectors.reserve(arrays.size());
  for (const Vector3Bytes& array : arrays) vectors.push_back(ToVector(array));
  const auto are_numbers = [](const Eigen::Vector3d& vector) { return AreNumbers(vector); };
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(std::ranges::all_of(vectors, are_numbers), what, "they are no numbers"));
  return vectors;
}

void ToProto(const Reconstruction& reconstruction, v1::Reconstruction* proto) {
  ImagesToProto(reconstruction, proto);
  TracksToProto(reconstruction, proto);
}

absl::StatusOr<Reconstruction> FromProto(const v1::Reconstruction& proto) {
  Reconstruction reconstruction;
  ORBWEAVE_RETURN_IF_ERROR(ImagesFromProto(proto, reconstruction));
  ORBWEAVE_RETURN_IF_ERROR(UncertaintiesFromProto(proto, reconstruction));
  ORBWEAVE_RETURN_IF_ERROR(TracksFromProto(proto, reconstruction));
  return reconstruction;
}

void ToProto(const GnssReport& gnss, v1::GnssReport* proto) {
  proto->set_used(gnss.used);
  proto->set_reason(gnss.reason);
  proto->set_num_priors(gnss.num_priors);
  proto->set_num_inliers(gnss.num_inliers);
  proto->set_residual_median_m(gnss.residual_median_m);
  proto->set_residual_rms_inliers_m(gnss.residual_rms_inliers_m);
  proto->set_deformation_m(gnss.deformation_m);
  for (const std::string& name : gnss.outliers) proto->add_outliers(name);
}

absl::StatusOr<GnssReport> FromProto(const v1::GnssReport& proto) {
  GnssReport report{.used = proto.used(),
                    .reason = proto.reason(),
                    .num_priors = proto.num_priors(),
                    .num_inliers = proto.num_inliers(),
                    .residual_median_m = proto.residual_median_m(),
                    .residual_rms_inliers_m = proto.residual_rms_inliers_m(),
                    .deformation_m = proto.deformation_m(),
                    .outliers = {proto.outliers().begin(), proto.outliers().end()}};
  ORBWEAVE_RETURN_IF_ERROR(Expect(IsAmount(report.residual_median_m) &&
                                      IsAmount(report.residual_rms_inliers_m) &&
                                      IsAmount(report.deformation_m),
                                  "GNSS report",
                                  "a distance is none"));
  ORBWEAVE_RETURN_IF_ERROR(Expect(report.num_inliers <= report.num_priors,
                                  "GNSS report",
                                  "more positions agree than there are"));
  return report;
}

void ToProto(const UncertaintyReport& report, v1::UncertaintyReport* proto) {
  proto->set_known(report.known);
  proto->set_reason(report.reason);
  proto->set_held_image(report.held_image);
  proto->set_held_distance_to(report.held_distance_to);
  proto->set_bearing_sigma_factor(report.bearing_sigma_factor);
  proto->set_horizontal_gnss_sigma_factor(report.horizontal_gnss_sigma_factor);
  proto->set_vertical_gnss_sigma_factor(report.vertical_gnss_sigma_factor);
}

absl::StatusOr<UncertaintyReport> FromProto(const v1::UncertaintyReport& proto) {
  UncertaintyReport report{.known = proto.known(),
                           .reason = proto.reason(),
                           .held_image = proto.held_image(),
                           .held_distance_to = proto.held_distance_to(),
                           .bearing_sigma_factor = proto.bearing_sigma_factor(),
                           .horizontal_gnss_sigma_factor = proto.horizontal_gnss_sigma_factor(),
                           .vertical_gnss_sigma_factor = proto.vertical_gnss_sigma_factor()};
  ORBWEAVE_RETURN_IF_ERROR(Expect(IsAmount(report.bearing_sigma_factor) &&
                                      IsAmount(report.horizontal_gnss_sigma_factor) &&
                                      IsAmount(report.vertical_gnss_sigma_factor),
                                  "uncertainty report",
                                  "a factor is none"));
  return report;
}

void ToProto(const BundleReport& report, v1::BundleReport* proto) {
  proto->set_initial_cost(report.initial_cost);
  proto->set_final_cost(report.final_cost);
  proto->set_iterations(report.iterations);
  proto->set_converged(report.converged);
  proto->set_biases_m(PackVectors(report.biases_m));
}

absl::StatusOr<BundleReport> FromProto(const v1::BundleReport& proto) {
  BundleReport report{.initial_cost = proto.initial_cost(),
                      .final_cost = proto.final_cost(),
                      .iterations = proto.iterations(),
                      .converged = proto.converged()};
  ORBWEAVE_ASSIGN_OR_RETURN(report.biases_m, UnpackVectors(proto.biases_m(), "biases"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(IsAmount(report.initial_cost) && IsAmount(report.final_cost) && report.iterations >= 0,
             "adjustment report",
             "a cost or a count is none"));
  return report;
}

}  // namespace orbweave::codec
