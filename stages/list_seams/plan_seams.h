// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/digest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Per cluster what FitSeams reads of it: its boundary, then those of the later clusters that it
/// has a seam with, ascending. `boundaries`: per cluster.
[[nodiscard]] std::vector<std::vector<Digest>> PlanSeams(const Partition& partition,
                                                         const std::vector<Digest>& boundaries);

}  // namespace orbweave
