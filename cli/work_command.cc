// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/work_command.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <memory>

#include "absl/strings/str_cat.h"
#include "cli/exit_code.h"
#include "cli/log_line.h"
#include "cli/stop_signals.h"
#include "worker/grpc_coordinator_client.h"
#include "worker/task_process.h"

namespace orbweave {
namespace {

std::string DefaultName() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return absl::StrCat(host.data(), "-", ::getpid());
}

/// False when the parent is dead already.
bool DieWithParent(int parent_pid) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  return ::getppid() == parent_pid;
}

void AddTaskLimits(CLI::App& command, TaskLimits& limits) {
  command
      .add_option("--task-stall",
                  limits.stall_s,
                  "Seconds without progress or processor time after which a task hangs")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--task-limit", limits.total_s, "Longest time of a task in seconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--task-memory", limits.memory_bytes, "Memory of a task in bytes, as in 16GiB")
      ->transform(CLI::AsSizeValue(false));
}

absl::Status Work(const WorkOptions& options) {
  if (options.parent_pid != 0 && !DieWithParent(options.parent_pid)) return absl::OkStatus();
  const StopSignals signals;
  const SteadyClock clock;
  GrpcCoordinatorClient coordinator(options.join, signals.token());
  LogLine(absl::StrCat("worker started name=", options.worker.name, " coordinator=", options.join));
  const auto make_executor = [&options, &clock] {
    return std::make_unique<TaskProcess>(options.task_limits, clock);
  };
  const absl::Status status =
      RunWorker(coordinator, make_executor, options.worker, signals.token());
  LogLine(absl::StrCat("worker ended name=", options.worker.name));
  return status;
}

}  // namespace

void AddWorkCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("work", "Run a worker: do tasks for a coordinator");
  const auto options = std::make_shared<WorkOptions>();
  options->worker.name = DefaultName();
  options->worker.log = LogLine;
  command->add_option("--join", options->join, "Address of the coordinator")->required();
  command->add_option("--slots", options->worker.slots, "Tasks at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--threads", options->worker.threads_per_task, "Threads of one task")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      ->add_option("--name", options->worker.name, "Name, unique among the coordinator's workers")
      ->capture_default_str();
  command->add_option("--grace", options->worker.grace_s, "Seconds for running tasks after SIGTERM")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  AddTaskLimits(*command, options->task_limits);
  command
      ->add_option("--parent-pid", options->parent_pid, "End when this process, its parent, ends")
      ->group("");
  command->footer(
      "Examples:\n"
      "  orbweave work --join 127.0.0.1:7000 --slots 2\n"
      "  orbweave work --join unix:/tmp/orbweave.sock --name second\n"
      "SIGTERM: takes no more tasks, gives back what does not end within the grace, and leaves.");
  command->callback(
      [options, &selected] { selected.run = [options] { return ReportStatus(Work(*options)); }; });
}

}  // namespace orbweave
