// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/status.h"
#include "core/partitioned_ba/subproblem_solver.h"
#include "core/scene/cross_check.h"
#include "orbweave/v1/adjustment.pb.h"

/// Messages of the global adjustment that several artifacts hold.

namespace orbweave::codec {

void ToProto(const std::vector<SubproblemBias>& biases, v1::Biases* proto);
[[nodiscard]] absl::StatusOr<std::vector<SubproblemBias>> FromProto(const v1::Biases& proto);

void ToProto(const std::vector<SeparatorId>& ids, v1::SeparatorIds* proto);
[[nodiscard]] absl::StatusOr<std::vector<SeparatorId>> FromProto(const v1::SeparatorIds& proto);

void ToProto(const SeparatorSystem& system, v1::SeparatorSystem* proto);
/// DataLoss also for a matrix whose blocks are not an upper triangle in order, or no
/// numbers.
[[nodiscard]] absl::StatusOr<SeparatorSystem> FromProto(const v1::SeparatorSystem& proto);

void ToProto(const std::vector<ShortenedPoint>& points, v1::ShortenedPoints* proto);
[[nodiscard]] absl::StatusOr<std::vector<ShortenedPoint>> FromProto(
    const v1::ShortenedPoints& proto);

void ToProto(const SubproblemSummary& summary, v1::SubproblemSummary* proto);
[[nodiscard]] absl::StatusOr<SubproblemSummary> FromProto(const v1::SubproblemSummary& proto);

void ToProto(const CrossCheck& check, v1::CrossCheck* proto);
[[nodiscard]] absl::StatusOr<CrossCheck> FromProto(const v1::CrossCheck& proto);

void ToProto(const TrialCost& trial, v1::TrialCost* proto);
[[nodiscard]] absl::StatusOr<TrialCost> FromProto(const v1::TrialCost& proto);

}  // namespace orbweave::codec
