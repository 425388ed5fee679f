// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/features_codec.h"

#include "proto/codec/pack.h"

namespace orbweave {

static_assert(sizeof(Keypoint) == 16 && sizeof(Rgb) == 3, "packed as written");

absl::StatusOr<std::string> EncodeFeatures(const Features& features) {
  v1::Features proto;
  proto.mutable_camera()->set_width_px(features.camera.width_px);
  proto.mutable_camera()->set_height_px(features.camera.height_px);
  proto.set_keypoints(codec::Pack(features.keypoints));
  proto.set_sigma_rad(codec::Pack(features.sigma_rad));
  proto.set_descriptors(codec::Pack(features.descriptors));
  proto.set_colors(codec::Pack(features.colors));
  proto.set_problem(features.problem);
  return codec::Serialize(proto, "features");
}

absl::StatusOr<Features> DecodeFeatures(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::Features proto,
                            codec::Parse<v1::Features>(bytes, "features"));
  Features features;
  features.camera = {proto.camera().width_px(), proto.camera().height_px()};
  features.problem = proto.problem();
  ORBWEAVE_ASSIGN_OR_RETURN(features.keypoints,
                            codec::Unpack<Keypoint>(proto.keypoints(), "keypoints"));
  const size_t n = features.keypoints.size();
  ORBWEAVE_ASSIGN_OR_RETURN(features.sigma_rad,
                            codec::UnpackExactly<float>(proto.sigma_rad(), n, "sigmas"));
  ORBWEAVE_ASSIGN_OR_RETURN(features.colors,
                            codec::UnpackExactly<Rgb>(proto.colors(), n, "colours"));
  const size_t descriptor_bytes = proto.descriptors().empty() ? 0 : n * kDescriptorSize;
  ORBWEAVE_ASSIGN_OR_RETURN(
      features.descriptors,
      codec::UnpackExactly<uint8_t>(proto.descriptors(), descriptor_bytes, "descriptors"));
  if (n > 0 && (features.camera.width_px <= 0 || features.camera.height_px <= 0)) {
    return absl::InvalidArgumentError("features: the camera has no size");
  }
  return features;
}

absl::StatusOr<std::string> EncodePlaceSample(const PlaceSample& sample) {
  v1::PlaceSample proto;
  proto.set_num_features(sample.num_features);
  proto.set_descriptors(codec::Pack(sample.descriptors));
  proto.set_problem(sample.problem);
  return codec::Serialize(proto, "place sample", codec::Empty::kIsLegal);
}

absl::StatusOr<PlaceSample> DecodePlaceSample(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::PlaceSample proto,
      codec::Parse<v1::PlaceSample>(bytes, "place sample", codec::Empty::kIsLegal));
  PlaceSample sample{.num_features = proto.num_features(), .problem = proto.problem()};
  ORBWEAVE_ASSIGN_OR_RETURN(sample.descriptors,
                            codec::Unpack<uint8_t>(proto.descriptors(), "descriptors"));
  if (sample.descriptors.size() % kDescriptorSize != 0) {
    return absl::InvalidArgumentError("place sample: half a descriptor");
  }
  return sample;
}

}  // namespace orbweave
