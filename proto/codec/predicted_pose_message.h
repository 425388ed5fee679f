// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/statusor.h"
#include "core/scene/predicted_pose.h"
#include "orbweave/v1/artifacts.pb.h"

/// A message that recipes and lists of pairs hold.

namespace orbweave::codec {

void ToProto(const PredictedPose& pose, v1::PredictedPose* proto);
/// DataLoss unless rotation and directions are of unit norm (1e-6).
[[nodiscard]] absl::StatusOr<PredictedPose> FromProto(const v1::PredictedPose& proto);

}  // namespace orbweave::codec
