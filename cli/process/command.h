// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace orbweave {

/// What the command line asked for. A subcommand `name` lives in name_command.{h,cc} and offers
///
///   void AddNameCommand(CLI::App& app, SelectedCommand& selected);
///
/// which declares its options on `app.add_subcommand(...)` and, in the subcommand's callback, sets
/// `selected.run`. main calls `run` once everything is parsed and returns what it returns: an exit
/// code of cli/process/exit_code.h.
struct SelectedCommand {
  std::function<int()> run{};
};

}  // namespace orbweave
