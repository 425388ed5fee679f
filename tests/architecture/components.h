// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace orbweave::architecture {

/// Which components each component includes, and where: "path:line" of the first such line. A
/// component is a header and its source, named by their common path without ending. A source
/// without a header of its own counts to the header of its folder whose name its own continues
/// (job_machine_report.cc to job_machine.h; the longest such), else for itself. What is not among
/// the files is left out.
using ComponentGraph = std::map<std::string, std::map<std::string, std::string>>;

[[nodiscard]] ComponentGraph FindComponents(const std::vector<SourceFile>& files);

/// Components that include each other in a circle: of every such group the shortest circle through
/// its first component by name, as
///   "core/a -> core/b (core/a.h:7), core/b -> core/a (core/b.cc:9)".
/// Empty when every component can be understood without those that include it.
[[nodiscard]] std::vector<std::string> FindCycles(const ComponentGraph& graph);

}  // namespace orbweave::architecture
