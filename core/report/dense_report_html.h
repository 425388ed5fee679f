// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/report/dense_report.h"

namespace orbweave {

/// dense/report.html: one self-contained page (HtmlPage): headline numbers, the cloud from above,
/// depth maps, sigmas, views, coverage of each panorama, what has no depth and why, time per stage.
[[nodiscard]] std::string DenseReportHtml(const DenseReport& report, const DensePictures& pictures);

}  // namespace orbweave
