// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/io/page/job_report.h"

namespace orbweave {

/// Sections of the page that are lists and tables of names. At most 200 rows of each, report.json
/// has all; empty when there is nothing to list. Warnings and reasons of one kind are one row with
/// their count.
[[nodiscard]] std::string ClustersHtml(const JobReport& report);
/// By the rung of the ladder that won them.
[[nodiscard]] std::string PairsHtml(const JobReport& report);
[[nodiscard]] std::string LeftOutHtml(const JobReport& report);
/// Images by the reason why they are left out.
[[nodiscard]] std::string ReasonsTable(const std::vector<Exclusion>& images);
[[nodiscard]] std::string WarningsHtml(const JobReport& report);
[[nodiscard]] std::string WorkersHtml(const JobReport& report);

}  // namespace orbweave
