// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/work_command.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <memory>

#include "absl/strings/str_cat.h"
#include "cli/arguments/join_token_argument.h"
#include "cli/process/event_log.h"
#include "cli/process/exit_code.h"
#include "cli/process/host_name.h"
#include "cli/process/stop_signals.h"
#include "security/tls_folder.h"
#include "security/unix_time.h"
#include "worker/certificate_keeper.h"
#include "worker/grpc_coordinator_client.h"
#include "worker/grpc_enrollment_client.h"
#include "worker/machine_offers.h"
#include "worker/task_process.h"

namespace orbweave {
namespace {

/// Renews the certificate as long as the worker works; null without one.
std::unique_ptr<CertificateKeeper> KeepCertificate(const CoordinatorArgument& join) {
  if (join.tls_folder.empty()) return nullptr;
  const TlsFolder folder{join.tls_folder};
  return std::make_unique<CertificateKeeper>(CertificateKeeperOptions{
      .folder = folder,
      .renew = [address = join.address, folder] { return RenewCertificate(address, folder); },
      .log = LogToStderr});
}

/// The host and the process; where there is a certificate its name goes before (see MaySpeakFor).
absl::StatusOr<std::string> DefaultName(const CoordinatorArgument& coordinator) {
  const std::string process = absl::StrCat(HostName(), "-", ::getpid());
  if (coordinator.tls_folder.empty()) return process;
  ORBWEAVE_ASSIGN_OR_RETURN(const CertificateFacts own, CheckTlsFolder({coordinator.tls_folder}));
  return absl::StrCat(own.identity.name, "/", process);
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
                  "Seconds without a sign of progress after which an idle task hangs, and "
                  "processor seconds after which a busy one spins")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--task-limit", limits.total_s, "Longest time of a task in seconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--task-memory", limits.memory_bytes, "Memory of a task in bytes, as in 16GiB")
      ->transform(CLI::AsSizeValue(false));
}

/// What was said on the command line, the rest as this machine has it.
WorkerOffers OffersOf(const WorkOptions& options) {
  const WorkerOffers machine = OffersOfMachine();
  return {.memory_bytes = options.memory_bytes.value_or(machine.memory_bytes),
          .threads = options.worker.slots * static_cast<uint32_t>(options.worker.threads_per_task),
          .gpus = options.gpus.value_or(machine.gpus)};
}

void AddOffers(CLI::App& command, WorkOptions& options) {
  command
      .add_option("--memory",
                  options.memory_bytes,
                  "Memory for all tasks together, in bytes or as in 64GiB; tasks that ask for more "
                  "go elsewhere (default: what this machine has)")
      ->transform(CLI::AsSizeValue(false));
  command.add_option("--gpus", options.gpus, "GPUs for tasks (default: those of this machine)");
}

std::string Describe(WorkerEnd end) {
  switch (end) {
    case WorkerEnd::kDismissed:
      return "it is needed no more";
    case WorkerEnd::kIdle:
      return "there was nothing to do";
    case WorkerEnd::kStopped:
      break;
  }
  return "it was told to end, or its time was up: there may be more to do";
}

/// Ctrl-C is of somebody who knows; an engine that stops a worker is to start it again.
absl::Status ToStatus(const absl::StatusOr<WorkerEnd>& end, int signal) {
  if (!end.ok() || *end != WorkerEnd::kStopped) return end.status();
  if (signal == SIGINT) return absl::CancelledError("interrupted");
  return StoppedError(Describe(*end));
}

absl::Status Work(const WorkOptions& options) {
  if (options.parent_pid != 0 && !DieWithParent(options.parent_pid)) return absl::OkStatus();
  const StopSignals signals;
  const SteadyClock clock;
  ORBWEAVE_RETURN_IF_ERROR(options.term.Begin(UnixNow()).status());
  const absl::Status enrolled = EnrolWhereNeeded({.coordinator = options.join,
                                                  .token_path = options.token_path,
                                                  .name = HostName(),
                                                  .patience_s = options.term.term.patience_s},
                                                 signals.token());
  if (signals.first() != 0) return ToStatus(WorkerEnd::kStopped, signals.first());
  ORBWEAVE_RETURN_IF_ERROR(enrolled);
  WorkerOptions worker = options.worker;
  ORBWEAVE_ASSIGN_OR_RETURN(worker.term, options.term.Begin(UnixNow()));
  ORBWEAVE_RETURN_IF_ERROR(options.join.Check());
  const auto keeper = KeepCertificate(options.join);
  worker.offers = OffersOf(options);
  if (worker.name.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(worker.name, DefaultName(options.join));
  }
  GrpcCoordinatorClient coordinator(options.join.address, {.tls_folder = options.join.tls_folder});
  LogToStderr({.event = "worker_started",
               .worker = worker.name,
               .message = absl::StrCat("coordinator=", options.join.address)});
  const auto make_executor = [&options, &clock] {
    return std::make_unique<TaskProcess>(options.task_limits, clock);
  };
  const absl::StatusOr<WorkerEnd> end =
      RunWorker(coordinator, coordinator, make_executor, worker, signals.token());
  LogToStderr({.level = end.ok() ? LogLevel::kInfo : LogLevel::kError,
               .event = "worker_ended",
               .worker = worker.name,
               .message = end.ok() ? Describe(*end) : std::string(end.status().message())});
  return ToStatus(end, signals.first());
}

}  // namespace

void AddWorkCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("work", "Run a worker: do tasks for a coordinator");
  const auto options = std::make_shared<WorkOptions>();
  options->worker.log = LogToStderr;
  AddJoinArgument(*command, options->join);
  AddJoinTokenArgument(*command, options->token_path);
  command->add_option("--slots", options->worker.slots, "Tasks at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--threads", options->worker.threads_per_task, "Threads of one task")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--name",
                      options->worker.name,
                      "Name, unique among the coordinator's workers (default: certificate's name, "
                      "host and process); with --tls the certificate's, or that and /more");
  command->add_option("--grace", options->worker.grace_s, "Seconds for running tasks after SIGTERM")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--cache",
                   options->worker.cache_bytes,
                   "Memory for blobs that other tasks may read again, in bytes or as in 2GiB")
      ->transform(CLI::AsSizeValue(false));
  command->add_option(
      "--blobs",
      options->worker.blob_folder,
      "The folder blobs in the coordinator's state folder, as this machine sees it; "
      "they are then read and written there and do not go through the coordinator");
  CLI::Option* const scratch = command->add_option(
      "--scratch",
      options->worker.scratch_folder,
      "Folder on a disk of this machine for copies of blobs that were read, of those used last");
  command
      ->add_option("--scratch-size",
                   options->worker.scratch_bytes,
                   "Bytes of that disk, or as in 50GiB (default: 16GiB)")
      ->transform(CLI::AsSizeValue(false))
      ->needs(scratch);
  AddWorkerTermArguments(*command, options->term);
  AddOffers(*command, *options);
  AddTaskLimits(*command, options->task_limits);
  command
      ->add_option("--parent-pid", options->parent_pid, "End when this process, its parent, ends")
      ->group("");
  command->footer(
      "Examples:\n"
      "  orbweave work --join 127.0.0.1:7000 --slots 2\n"
      "  orbweave work --join unix:/tmp/orbweave.sock --name second\n"
      "  orbweave work --join coordinator.example:7000 --tls keys/node7\n"
      "  orbweave work --join coordinator.example:7000 --tls keys/node7 --blobs "
      "storage/state/blobs\n"
      "  orbweave work --join coordinator.example:7000 --tls node-keys --token-file join.token\n"
      "  orbweave work --join @shared/coordinator.json --idle-exit 60 --until 2026-11-23T18:00:00\n"
      "SIGTERM: takes no more tasks, gives back what does not end within the grace, and leaves. "
      "Exit codes: 0 sent home or idle, 2 refused, 3 no coordinator within --patience, 75 stopped "
      "(there may be more to do: start it again), 130 Ctrl-C. "
      "The log goes to stderr, one JSON object per line.");
  command->callback(
      [options, &selected] { selected.run = [options] { return ReportStatus(Work(*options)); }; });
}

}  // namespace orbweave
