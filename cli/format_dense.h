// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cli/dense_report.h"

namespace orbweave {

/// A dense cloud on a terminal.
[[nodiscard]] std::string FormatDense(const DenseReport& report, const std::string& folder);

/// The same for machines.
[[nodiscard]] std::string DenseReportJson(const DenseReport& report);

}  // namespace orbweave
