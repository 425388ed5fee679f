// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"
#include "core/merging/checks/inspect_subproblem.h"

namespace orbweave {

/// Decoder: DataLoss for arrays that do not match and numbers that are none.
[[nodiscard]] absl::StatusOr<std::string> EncodeSubproblemInspection(
    const SubproblemInspection& inspection);
[[nodiscard]] absl::StatusOr<SubproblemInspection> DecodeSubproblemInspection(
    std::string_view bytes);

}  // namespace orbweave
