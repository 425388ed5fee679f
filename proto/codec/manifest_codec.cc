// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/manifest_codec.h"

#include <cmath>
#include <filesystem>

#include "proto/codec/exclusion_messages.h"
#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"

namespace orbweave {
namespace {

void ToProto(const GeodeticPosition& value, v1::GeodeticPosition* proto) {
  proto->set_latitude_deg(value.latitude_deg);
  proto->set_longitude_deg(value.longitude_deg);
  proto->set_altitude_m(value.altitude_m);
}

GeodeticPosition FromProto(const v1::GeodeticPosition& proto) {
  return {proto.latitude_deg(), proto.longitude_deg(), proto.altitude_m()};
}

/// An altitude that nobody knows is not a number.
bool IsOnEarth(const GeodeticPosition& value) {
  return codec::IsNumber(value.latitude_deg) && codec::IsNumber(value.longitude_deg) &&
         (std::isnan(value.altitude_m) || codec::IsLength(value.altitude_m));
}

template <typename Value>
bool IsAbsentOrNumber(const std::optional<Value>& value) {
  return !value || codec::IsNumber(*value);
}

/// Angles of view, the same three in metadata and priors.
template <typename Value>
bool HasAngles(const Value& value) {
  return IsAbsentOrNumber(value.heading_deg) && IsAbsentOrNumber(value.pitch_deg) &&
         IsAbsentOrNumber(value.roll_deg);
}

template <typename Value, typename Proto>
void AnglesToProto(const Value& value, Proto* proto) {
  if (value.heading_deg) proto->set_heading_deg(*value.heading_deg);
  if (value.pitch_deg) proto->set_pitch_deg(*value.pitch_deg);
  if (value.roll_deg) proto->set_roll_deg(*value.roll_deg);
}

template <typename Value, typename Proto>
void AnglesFromProto(const Proto& proto, Value& value) {
  if (proto.has_heading_deg()) value.heading_deg = proto.heading_deg();
  if (proto.has_pitch_deg()) value.pitch_deg = proto.pitch_deg();
  if (proto.has_roll_deg()) value.roll_deg = proto.roll_deg();
}

void ToProto(const ImageMetadata& value, v1::ImageMetadata* proto) {
  proto->set_width_px(value.width_px);
  proto->set_height_px(value.height_px);
  if (value.position) ToProto(*value.position, proto->mutable_position());
  proto->set_altitude_known(value.altitude_known);
  proto->set_altitude_of_ellipsoid(value.altitude_of_ellipsoid);
  if (value.position_error_m) proto->set_position_error_m(*value.position_error_m);
  AnglesToProto(value, proto);
  if (value.capture_time_s) proto->set_capture_time_s(*value.capture_time_s);
}

absl::StatusOr<ImageMetadata> FromProto(const v1::ImageMetadata& proto) {
  ImageMetadata value{.width_px = proto.width_px(), .height_px = proto.height_px()};
  if (proto.has_position()) value.position = FromProto(proto.position());
  value.altitude_known = proto.altitude_known();
  value.altitude_of_ellipsoid = proto.altitude_of_ellipsoid();
  if (proto.has_position_error_m()) value.position_error_m = proto.position_error_m();
  AnglesFromProto(proto, value);
  if (proto.has_capture_time_s()) value.capture_time_s = proto.capture_time_s();
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      (!value.position || IsOnEarth(*value.position)) && HasAngles(value) &&
          IsAbsentOrNumber(value.position_error_m) && IsAbsentOrNumber(value.capture_time_s),
      "image sources",
      "metadata that are no numbers"));
  return value;
}

void ToProto(const SourceImage& value, v1::SourceImage* proto) {
  proto->set_name(value.name);
  proto->set_content(codec::PackDigest(value.content));
  proto->set_size_bytes(value.size_bytes);
  ToProto(value.metadata, proto->mutable_metadata());
  proto->set_mask(codec::PackDigest(value.mask));
  proto->set_mask_name(std::filesystem::path(value.mask_path).filename().string());
  proto->set_mask_width_px(value.mask_width_px);
  proto->set_mask_height_px(value.mask_height_px);
  if (value.position_in_local)
    codec::ToProto(*value.position_in_local, proto->mutable_position_in_local());
  if (value.position_sigma_m) {
    proto->set_horizontal_sigma_m(value.position_sigma_m->x());
    proto->set_vertical_sigma_m(value.position_sigma_m->y());
  }
  proto->set_problem(value.problem);
}

absl::StatusOr<SourceImage> FromProto(const v1::SourceImage& proto) {
  SourceImage value{.name = proto.name(), .size_bytes = proto.size_bytes()};
  ORBWEAVE_ASSIGN_OR_RETURN(value.metadata, FromProto(proto.metadata()));
  ORBWEAVE_ASSIGN_OR_RETURN(value.content, codec::UnpackDigest(proto.content()));
  ORBWEAVE_ASSIGN_OR_RETURN(value.mask, codec::UnpackDigest(proto.mask()));
  value.mask_path = proto.mask_name();
  value.mask_width_px = proto.mask_width_px();
  value.mask_height_px = proto.mask_height_px();
  if (proto.has_position_in_local())
    value.position_in_local = codec::FromProto(proto.position_in_local());
  if (proto.has_horizontal_sigma_m()) {
    value.position_sigma_m = Eigen::Vector2d(proto.horizontal_sigma_m(), proto.vertical_sigma_m());
  }
  value.problem = proto.problem();
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect((!value.position_in_local || codec::IsPlace(*value.position_in_local)) &&
                        (!value.position_sigma_m || (codec::IsSigma(value.position_sigma_m->x()) &&
                                                     codec::IsSigma(value.position_sigma_m->y()))),
                    "image sources",
                    "a position or its sigma is none"));
  return value;
}

void ToProto(const PosePrior& value, v1::PosePrior* proto) {
  if (value.geodetic) ToProto(*value.geodetic, proto->mutable_geodetic());
  if (value.position_in_enu)
    codec::ToProto(*value.position_in_enu, proto->mutable_position_in_enu());
  proto->set_horizontal_sigma_m(value.horizontal_sigma_m);
  proto->set_vertical_sigma_m(value.vertical_sigma_m);
  AnglesToProto(value, proto);
  proto->set_heading_sigma_deg(value.heading_sigma_deg);
  proto->set_tilt_sigma_deg(value.tilt_sigma_deg);
}

PosePrior FromProto(const v1::PosePrior& proto) {
  PosePrior value{.horizontal_sigma_m = proto.horizontal_sigma_m(),
                  .vertical_sigma_m = proto.vertical_sigma_m()};
  if (proto.has_geodetic()) value.geodetic = FromProto(proto.geodetic());
  if (proto.has_position_in_enu())
    value.position_in_enu = codec::FromProto(proto.position_in_enu());
  AnglesFromProto(proto, value);
  if (proto.has_heading_sigma_deg()) value.heading_sigma_deg = proto.heading_sigma_deg();
  if (proto.has_tilt_sigma_deg()) value.tilt_sigma_deg = proto.tilt_sigma_deg();
  return value;
}

absl::Status CheckPrior(const PosePrior& prior) {
  using codec::Expect;
  constexpr char kWhat[] = "image manifest";
  ORBWEAVE_RETURN_IF_ERROR(
      Expect((!prior.geodetic || IsOnEarth(*prior.geodetic)) &&
                 (!prior.position_in_enu || codec::IsPlace(*prior.position_in_enu)),
             kWhat,
             "a position that is nowhere"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(codec::IsSigma(prior.horizontal_sigma_m) && codec::IsSigma(prior.vertical_sigma_m),
             kWhat,
             "the sigma of a position is not positive"));
  ORBWEAVE_RETURN_IF_ERROR(Expect(HasAngles(prior), kWhat, "a direction is no number"));
  return Expect(codec::IsSigma(prior.heading_sigma_deg) && codec::IsSigma(prior.tilt_sigma_deg),
                kWhat,
                "the sigma of a direction is not positive");
}

void ToProto(const ImageRecord& value, v1::ImageRecord* proto) {
  proto->set_name(value.name);
  proto->set_content(codec::PackDigest(value.content));
  proto->set_mask(codec::PackDigest(value.mask));
  proto->mutable_camera()->set_width_px(value.camera.width_px);
  proto->mutable_camera()->set_height_px(value.camera.height_px);
  ToProto(value.prior, proto->mutable_prior());
  if (value.capture_time_s) proto->set_capture_time_s(*value.capture_time_s);
  proto->set_drive(value.drive);
}

absl::StatusOr<ImageRecord> FromProto(const v1::ImageRecord& proto) {
  ImageRecord value{.name = proto.name(),
                    .camera = {proto.camera().width_px(), proto.camera().height_px()},
                    .prior = FromProto(proto.prior()),
                    .drive = proto.drive()};
  ORBWEAVE_ASSIGN_OR_RETURN(value.content, codec::UnpackDigest(proto.content()));
  ORBWEAVE_ASSIGN_OR_RETURN(value.mask, codec::UnpackDigest(proto.mask()));
  if (proto.has_capture_time_s()) value.capture_time_s = proto.capture_time_s();
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::IsSize(value.camera.width_px) && codec::IsSize(value.camera.height_px),
                    "image manifest",
                    "a camera has no size"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      IsAbsentOrNumber(value.capture_time_s), "image manifest", "a time is no number"));
  ORBWEAVE_RETURN_IF_ERROR(CheckPrior(value.prior));
  return value;
}

}  // namespace

absl::StatusOr<std::string> EncodeImageSources(const ImageSources& sources) {
  v1::ImageSources proto;
  for (const SourceImage& image : sources.images) ToProto(image, proto.add_images());
  proto.set_mask_ignores_white(sources.mask_ignores_white);
  proto.set_gnss_text(sources.gnss_text);
  proto.set_gnss_name(sources.gnss_name);
  for (const std::string& warning : sources.warnings) proto.add_warnings(warning);
  return codec::Serialize(proto, "image sources");
}

absl::StatusOr<ImageSources> DecodeImageSources(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::ImageSources proto,
                            codec::Parse<v1::ImageSources>(bytes, "image sources"));
  ImageSources sources;
  for (const v1::SourceImage& image : proto.images()) {
    ORBWEAVE_ASSIGN_OR_RETURN(SourceImage decoded, FromProto(image));
    sources.images.push_back(std::move(decoded));
  }
  if (sources.images.empty()) return absl::DataLossError("image sources: no image");
  sources.mask_ignores_white = proto.mask_ignores_white();
  sources.gnss_text = proto.gnss_text();
  sources.gnss_name = proto.gnss_name();
  sources.warnings.assign(proto.warnings().begin(), proto.warnings().end());
  return sources;
}

absl::StatusOr<std::string> EncodeClusterNames(const ClusterNames& clusters) {
  v1::ClusterNames proto;
  for (const auto& [image, cluster] : clusters) {
    proto.add_images(image);
    proto.add_clusters(cluster);
  }
  return codec::Serialize(proto, "cluster names", codec::Empty::kIsLegal);
}

absl::StatusOr<ClusterNames> DecodeClusterNames(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::ClusterNames proto,
      codec::Parse<v1::ClusterNames>(bytes, "cluster names", codec::Empty::kIsLegal));
  if (proto.images_size() != proto.clusters_size())
    return absl::DataLossError("cluster names: one cluster per image");
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::Ascends(proto.images()), "cluster names", "images are not in order"));
  ClusterNames clusters;
  for (int i = 0; i < proto.images_size(); ++i) clusters[proto.images(i)] = proto.clusters(i);
  return clusters;
}

absl::StatusOr<std::string> EncodeImageManifest(const ImageManifest& manifest) {
  v1::ImageManifest proto;
  for (const ImageRecord& image : manifest.images) ToProto(image, proto.add_images());
  codec::ToProto(manifest.excluded, proto.mutable_excluded());
  for (const std::string& warning : manifest.warnings) proto.add_warnings(warning);
  if (manifest.origin) ToProto(*manifest.origin, proto.mutable_origin());
  proto.set_mask_ignores_white(manifest.mask_ignores_white);
  return codec::Serialize(proto, "image manifest");
}

absl::StatusOr<ImageManifest> DecodeImageManifest(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::ImageManifest proto,
                            codec::Parse<v1::ImageManifest>(bytes, "image manifest"));
  ImageManifest manifest;
  for (const v1::ImageRecord& image : proto.images()) {
    ORBWEAVE_ASSIGN_OR_RETURN(ImageRecord record, FromProto(image));
    record.id = ImageId(static_cast<uint32_t>(manifest.images.size()));
    manifest.images.push_back(std::move(record));
  }
  manifest.excluded = codec::FromProto(proto.excluded());
  if (manifest.images.empty() && manifest.excluded.empty())
    return absl::DataLossError("image manifest: no image");
  manifest.warnings.assign(proto.warnings().begin(), proto.warnings().end());
  if (proto.has_origin()) manifest.origin = FromProto(proto.origin());
  if (manifest.origin &&
      !(IsOnEarth(*manifest.origin) && std::isfinite(manifest.origin->altitude_m)))
    return absl::DataLossError("image manifest: its frame is not on earth");
  manifest.mask_ignores_white = proto.mask_ignores_white();
  return manifest;
}

}  // namespace orbweave
