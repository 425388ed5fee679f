// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/report/dense_report.h"

namespace orbweave {

/// A dense cloud in numbers, for machines.
[[nodiscard]] std::string DenseReportJson(const DenseReport& report);

}  // namespace orbweave
