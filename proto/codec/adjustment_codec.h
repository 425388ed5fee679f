// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/artifacts/adjustment_records.h"
#include "core/base/status.h"

/// What passes between the rounds of the global adjustment. Decoders: DataLoss for arrays
/// that do not match, numbers that are none, and lists out of order.

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeSubproblemTask(const SubproblemTask& task);
[[nodiscard]] absl::StatusOr<SubproblemTask> DecodeSubproblemTask(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeSubproblemResult(const SubproblemResult& result);
[[nodiscard]] absl::StatusOr<SubproblemResult> DecodeSubproblemResult(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeAdjustmentProgress(
    const AdjustmentProgress& progress);
[[nodiscard]] absl::StatusOr<AdjustmentProgress> DecodeAdjustmentProgress(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeFinalisedModel(const FinalisedModel& model);
[[nodiscard]] absl::StatusOr<FinalisedModel> DecodeFinalisedModel(std::string_view bytes);

}  // namespace orbweave
