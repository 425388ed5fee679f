// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "cli/arguments/option_arguments.h"
#include "cli/bench/bench_engine.h"

namespace orbweave {

/// Nodes are network namespaces of this machine (NodeNetwork). Errors of NodeNetwork::Make and
/// MakeKeyStore.
[[nodiscard]] absl::StatusOr<std::unique_ptr<BenchEngine>> MakeNetnsEngine(
    const EngineArgument& argument, const OptionArguments& options, const std::string& scratch);

}  // namespace orbweave
