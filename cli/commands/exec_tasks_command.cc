// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/exec_tasks_command.h"

#include <memory>

#include "cli/process/exit_code.h"
#include "worker/child_process.h"
#include "worker/confine_process.h"
#include "worker/serve_tasks.h"

namespace orbweave {

void AddExecTasksCommand(CLI::App& app, SelectedCommand& selected, const StageLookup& stages) {
  CLI::App* command =
      app.add_subcommand("exec-tasks", "Run the tasks of a worker that started this");
  command->group("");
  const auto memory_bytes = std::make_shared<uint64_t>(0);
  command->add_option("--memory", *memory_bytes, "Limit in bytes; 0: none");
  command->callback([memory_bytes, &selected, &stages] {
    selected.run = [memory_bytes, &stages] {
      ConfineProcess(*memory_bytes);
      ServeTasks(FileDescriptor(kChannelDescriptor), stages, SteadyClock());
      return kExitOk;
    };
  });
}

}  // namespace orbweave
