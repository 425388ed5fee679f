// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <span>
#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// Observations by residual, a mark at the mean, as an SVG element.
[[nodiscard]] std::string ResidualHistogramSvg(const JobReport& report);
/// Points by the number of images that see them.
[[nodiscard]] std::string TrackLengthSvg(const JobReport& report);
/// Tracks seen by each image in order, coloured by cluster; groups of images share a bar when there
/// are many. Two drawings, one of them for narrow pages.
[[nodiscard]] std::string TracksPerImageSvg(const JobReport& report);
/// Wall and CPU time of each stage, as a section of the page; empty without stages.
[[nodiscard]] std::string TimesHtml(double elapsed_s, std::span<const ReportStage> stages);

}  // namespace orbweave
