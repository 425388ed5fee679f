// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/artifacts/stage_results.h"
#include "core/base/status.h"
#include "core/merging/alignment/alignment.h"
#include "core/merging/alignment/review_seams.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeReconstruction(
    const Reconstruction& reconstruction);
/// DataLoss: arrays that do not match, a pose that is no rigid motion, a bearing
/// that is no unit vector, a point nowhere, an observation of an image that is not registered.
[[nodiscard]] absl::StatusOr<Reconstruction> DecodeReconstruction(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeClusterResult(const ClusterResult& result);
[[nodiscard]] absl::StatusOr<ClusterResult> DecodeClusterResult(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeAlignment(const Alignment& alignment);
/// DataLoss also for worlds and seams of submodels that there are not.
[[nodiscard]] absl::StatusOr<Alignment> DecodeAlignment(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodePartitionReview(const PartitionReview& review);
[[nodiscard]] absl::StatusOr<PartitionReview> DecodePartitionReview(std::string_view bytes);

}  // namespace orbweave
