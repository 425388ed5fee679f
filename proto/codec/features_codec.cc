// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/features_codec.h"

#include <algorithm>
#include <numbers>

#include "core/geometry/facade_view.h"
#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"

namespace orbweave {

static_assert(sizeof(Keypoint) == 16 && sizeof(Rgb) == 3, "packed as written");

namespace {

constexpr float kTolerance_px = 2.0F;  // import takes what is one pixel outside

bool LiesIn(const EquirectangularCamera& camera, const Keypoint& keypoint) {
  const auto is_within = [](float value, int size_px) {
    return value >= -kTolerance_px && value <= static_cast<float>(size_px) + kTolerance_px;
  };
  return is_within(keypoint.x_px, camera.width_px) && is_within(keypoint.y_px, camera.height_px) &&
         codec::IsLength(keypoint.scale_px) && codec::IsLength(keypoint.orientation_rad);
}

bool IsAngularSigma(float sigma_rad) {
  return codec::IsSigma(sigma_rad) && sigma_rad <= std::numbers::pi_v<float>;
}

absl::Status CheckFeatures(const Features& features) {
  using codec::Expect;
  const auto lies_inside = [&](const Keypoint& k) { return LiesIn(features.camera, k); };
  if (features.size() == 0) return absl::OkStatus();
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(codec::IsSize(features.camera.width_px) && codec::IsSize(features.camera.height_px),
             "features",
             "the camera has no size"));
  ORBWEAVE_RETURN_IF_ERROR(Expect(std::ranges::all_of(features.keypoints, lies_inside),
                                  "features",
                                  "a keypoint is not in the image"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(std::ranges::is_sorted(features.view) &&
                 (features.view.empty() || features.view.back() <= kNumFacadeViews),
             "features",
             "views are not in order"));
  return Expect(
      std::ranges::all_of(features.sigma_rad, IsAngularSigma), "features", "a sigma is no angle");
}

}  // namespace

absl::StatusOr<std::string> EncodeFeatures(const Features& features) {
  v1::Features proto;
  proto.mutable_camera()->set_width_px(features.camera.width_px);
  proto.mutable_camera()->set_height_px(features.camera.height_px);
  proto.set_keypoints(codec::Pack(features.keypoints));
  proto.set_sigma_rad(codec::Pack(features.sigma_rad));
  proto.set_descriptors(codec::Pack(features.descriptors));
  proto.set_colors(codec::Pack(features.colors));
  proto.set_view(codec::Pack(features.view));
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
  ORBWEAVE_ASSIGN_OR_RETURN(
      features.view,
      codec::UnpackExactly<uint8_t>(proto.view(), proto.view().empty() ? 0 : n, "views"));
  ORBWEAVE_RETURN_IF_ERROR(CheckFeatures(features));
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
    return absl::DataLossError("place sample: half a descriptor");
  }
  return sample;
}

}  // namespace orbweave
