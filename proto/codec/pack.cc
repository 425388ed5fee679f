// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/pack.h"

#include "proto/codec/plausible.h"

namespace orbweave::codec {

std::string PackDigest(const Digest& digest) {
  return digest.IsZero() ? std::string() : std::string(digest.bytes.begin(), digest.bytes.end());
}

absl::StatusOr<Digest> UnpackDigest(const std::string& bytes) {
  Digest digest;
  if (bytes.empty()) return digest;
  if (bytes.size() != digest.bytes.size()) return absl::DataLossError("a digest has 32 bytes");
  std::memcpy(digest.bytes.data(), bytes.data(), bytes.size());
  return digest;
}

void ToProto(const Eigen::Vector3d& value, v1::Vector3* proto) {
  proto->set_x(value.x());
  proto->set_y(value.y());
  proto->set_z(value.z());
}

Eigen::Vector3d FromProto(const v1::Vector3& proto) { return {proto.x(), proto.y(), proto.z()}; }

void ToProto(const Rigid3& value, v1::Rigid3* proto) {
  proto->set_qw(value.rotation.w());
  proto->set_qx(value.rotation.x());
  proto->set_qy(value.rotation.y());
  proto->set_qz(value.rotation.z());
  ToProto(value.translation, proto->mutable_translation());
}

absl::StatusOr<Rigid3> FromProto(const v1::Rigid3& proto) {
  const Rigid3 value{Eigen::Quaterniond(proto.qw(), proto.qx(), proto.qy(), proto.qz()),
                     FromProto(proto.translation())};
  if (!IsPlace(value.translation) || !(std::abs(value.rotation.norm() - 1.0) < 1e-6)) {
    return absl::DataLossError("a pose is not a rigid motion, or leads nowhere");
  }
  return value;
}

void ToProto(const Sim3& value, v1::Sim3* proto) {
  proto->set_scale(value.scale);
  ToProto(Rigid3{value.rotation, value.translation}, proto->mutable_rigid());
}

absl::StatusOr<Sim3> FromProto(const v1::Sim3& proto) {
  const v1::Rigid3& rigid = proto.rigid();
  const Sim3 value{proto.scale(),
                   Eigen::Quaterniond(rigid.qw(), rigid.qx(), rigid.qy(), rigid.qz()),
                   FromProto(rigid.translation())};
  if (!(std::abs(value.rotation.norm() - 1.0) < 1e-6) || !AreNumbers(value.translation))
    return absl::DataLossError("a similarity does not turn, or leads nowhere");
  if (!(value.scale > 0.0) || !IsNumber(value.scale))
    return absl::DataLossError("the scale of a similarity is not positive");
  return value;
}

absl::StatusOr<Sim3> PlacementFromProto(const v1::Sim3& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const Sim3 value, FromProto(proto));
  if (IsPlacement(value)) return value;
  return absl::DataLossError("a similarity puts a model where nothing can be");
}

}  // namespace orbweave::codec
