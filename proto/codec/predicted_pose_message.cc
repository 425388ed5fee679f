// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/predicted_pose_message.h"

#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"

namespace orbweave::codec {

void ToProto(const PredictedPose& pose, v1::PredictedPose* proto) {
  ToProto(Rigid3{pose.rotation, pose.first}, proto->mutable_rotation_and_first());
  ToProto(pose.last, proto->mutable_last());
}

absl::StatusOr<PredictedPose> FromProto(const v1::PredictedPose& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const Rigid3 pose, FromProto(proto.rotation_and_first()));
  const Eigen::Vector3d last = FromProto(proto.last());
  if (!IsDirection(pose.translation) || !IsDirection(last))
    return absl::DataLossError("a predicted pose leads nowhere");
  return PredictedPose{pose.rotation, pose.translation, last};
}

}  // namespace orbweave::codec
