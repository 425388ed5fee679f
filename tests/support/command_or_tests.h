// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <string>

#include "cli/process/command.h"
#include "cli/process/exit_code.h"

namespace orbweave::testing {

/// main() of tests that start themselves as the program they test: a first argument that is no
/// option is a command, one of those that `add(app, selected)` declares.
template <typename AddCommands>
int RunCommandOrTests(int argc, char** argv, const AddCommands& add) {
  if (argc < 2 || argv[1][0] == '-') {
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
  }
  CLI::App app;
  SelectedCommand selected;
  add(app, selected);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError&) {
    return kExitUsage;
  }
  return selected.run();
}

}  // namespace orbweave::testing
