// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"
#include "core/stages/adjustment_records.h"

/// What passes between the rounds of the global adjustment. Decoders: DataLoss or InvalidArgument
/// for arrays that do not match.

namespace orbweave {

[[nodiscard]] std::string EncodeBlockTask(const BlockTask& task);
[[nodiscard]] absl::StatusOr<BlockTask> DecodeBlockTask(std::string_view bytes);

[[nodiscard]] std::string EncodeBlockResult(const BlockResult& result);
[[nodiscard]] absl::StatusOr<BlockResult> DecodeBlockResult(std::string_view bytes);

[[nodiscard]] std::string EncodeAdjustmentProgress(const AdjustmentProgress& progress);
[[nodiscard]] absl::StatusOr<AdjustmentProgress> DecodeAdjustmentProgress(std::string_view bytes);

[[nodiscard]] std::string EncodeConcludedModel(const ConcludedModel& model);
[[nodiscard]] absl::StatusOr<ConcludedModel> DecodeConcludedModel(std::string_view bytes);

}  // namespace orbweave
