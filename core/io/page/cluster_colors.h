// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/io/page/job_report.h"

namespace orbweave {

/// Colours that people tell apart whatever their eyes see (Okabe and Ito 2002, without those that
/// stand for states or are too light), as classes of the stylesheet: k0 to k4.
inline constexpr int kMapColors = 5;
/// Looks that ColorClass tells apart: filled and hollow.
inline constexpr int kMapLooks = 2 * kMapColors;

/// "k0" ... "k4" for 0 to 4, the same hollow for 5 to 9 ("k0 hollow"), and so on in turn; "kn",
/// grey, below zero.
[[nodiscard]] std::string ColorClass(int color);

/// A colour per cluster, another one than those of the clusters it has seams with where five
/// suffice.
[[nodiscard]] std::vector<int> ColorsOfClusters(const JobReport& report);

}  // namespace orbweave
