// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/report/dense_report.h"

namespace orbweave {

/// A dense cloud on a terminal.
[[nodiscard]] std::string FormatDense(const DenseReport& report, const std::string& folder);

}  // namespace orbweave
