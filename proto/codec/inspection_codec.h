// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"
#include "core/merging/inspect_block.h"

namespace orbweave {

/// Decoder: DataLoss or InvalidArgument for arrays that do not match.
[[nodiscard]] std::string EncodeBlockInspection(const BlockInspection& inspection);
[[nodiscard]] absl::StatusOr<BlockInspection> DecodeBlockInspection(std::string_view bytes);

}  // namespace orbweave
