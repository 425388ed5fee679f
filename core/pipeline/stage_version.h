// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace orbweave {

/// The version of a stage's algorithm. It is part of a task's id: whoever changes what a stage
/// computes raises its number in the table, and results of the older code are not taken for those
/// of the newer. "0" for a stage the table does not know.
[[nodiscard]] std::string_view StageVersion(std::string_view stage);

}  // namespace orbweave
