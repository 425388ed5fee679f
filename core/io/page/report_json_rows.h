// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/io/json_text.h"
#include "core/io/page/job_report.h"

namespace orbweave {

/// What the reports of all kinds of jobs have alike.

[[nodiscard]] Json VectorJson(const Eigen::Vector3d& vector);
/// Time and tasks of each stage.
[[nodiscard]] Json StagesJson(std::span<const ReportStage> stages);

}  // namespace orbweave
