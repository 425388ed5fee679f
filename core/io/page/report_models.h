// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// The written models as a table: what each holds, how well it is known and where it lies. Empty
/// for fewer than two.
[[nodiscard]] std::string ModelsHtml(const JobReport& report);

}  // namespace orbweave
