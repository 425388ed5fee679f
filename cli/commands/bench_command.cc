// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/bench_command.h"

#include "cli/bench/bench_dense.h"
#include "cli/bench/bench_measure.h"
#include "cli/bench/bench_scaling.h"

namespace orbweave {

void AddBenchCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("bench", "Measure this program");
  command->require_subcommand(1);
  AddBenchMeasure(*command, selected);
  AddBenchScaling(*command, selected);
  AddBenchDense(*command, selected);
}

}  // namespace orbweave
