// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/pack.h"

namespace orbweave::codec {

std::string PackDigest(const Digest& digest) {
  return digest.IsZero() ? std::string() : std::string(digest.bytes.begin(), digest.bytes.end());
}

absl::StatusOr<Digest> UnpackDigest(const std::string& bytes) {
  Digest digest;
  if (bytes.empty()) return digest;
  if (bytes.size() != digest.bytes.size())
    return absl::InvalidArgumentError("a digest has 32 bytes");
  std::memcpy(digest.bytes.data(), bytes.data(), bytes.size());
  return digest;
}

void ToProto(const Rigid3& value, v1::Rigid3* proto) {
  proto->set_qw(value.rotation.w());
  proto->set_qx(value.rotation.x());
  proto->set_qy(value.rotation.y());
  proto->set_qz(value.rotation.z());
  proto->mutable_translation()->set_x(value.translation.x());
  proto->mutable_translation()->set_y(value.translation.y());
  proto->mutable_translation()->set_z(value.translation.z());
}

absl::StatusOr<Rigid3> FromProto(const v1::Rigid3& proto) {
  const auto& t = proto.translation();
  const Rigid3 value{Eigen::Quaterniond(proto.qw(), proto.qx(), proto.qy(), proto.qz()),
                     Eigen::Vector3d(t.x(), t.y(), t.z())};
  if (!value.translation.allFinite() || !(std::abs(value.rotation.norm() - 1.0) < 1e-6)) {
    return absl::InvalidArgumentError("a pose is not a rigid motion");
  }
  return value;
}

void ToProto(const Sim3& value, v1::Sim3* proto) {
  proto->set_scale(value.scale);
  ToProto(Rigid3{value.rotation, value.translation}, proto->mutable_rigid());
}

absl::StatusOr<Sim3> FromProto(const v1::Sim3& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const Rigid3 rigid, FromProto(proto.rigid()));
  if (!(proto.scale() > 0.0) || !std::isfinite(proto.scale())) {
    return absl::InvalidArgumentError("the scale of a similarity is not positive");
  }
  return Sim3{proto.scale(), rigid.rotation, rigid.translation};
}

}  // namespace orbweave::codec
