// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/serve_command.h"

#include <atomic>
#include <csignal>
#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "cli/arguments/coordinator_argument.h"
#include "cli/arguments/fleet_argument.h"
#include "cli/arguments/store_argument.h"
#include "cli/fleet/monitoring.h"
#include "cli/fleet/see_workers_off.h"
#include "cli/process/announce.h"
#include "cli/process/event_log.h"
#include "cli/process/exit_code.h"
#include "cli/process/stop_signals.h"
#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
#include "coordinator/journal/open_journal.h"
#include "coordinator/journal/postgres_journal.h"
#include "core/base/sleep.h"

namespace orbweave {
namespace {

struct ServeOptions {
  std::string listen{};
  std::string journal{};         ///< of a PostgreSQL database; empty: in the state folder
  std::string journal_folder{};  ///< where it is instead, with a copy in the state folder
  StoreArgument store{};
  MonitoringArgument monitoring{};
  AnnounceArgument announce{};
  ServerOptions server{};
  CoordinatorOptions coordinator{};
};

/// To stderr for who watches the process, and to a file beside the state for who comes later.
absl::StatusOr<EventLog> OpenLog(const std::string& state_dir) {
  ORBWEAVE_ASSIGN_OR_RETURN(EventLog file, OpenEventLog(CoordinatorLogPath(state_dir)));
  return [file = std::move(file)](const LogEvent& event) {
    file(event);
    LogToStderr(event);
  };
}

absl::StatusOr<std::unique_ptr<Journal>> OpenJournalOf(const ServeOptions& options,
                                                       const EventLog& log) {
  const std::string& state_dir = options.coordinator.state_dir;
  if (!options.journal.empty()) return OpenPostgresJournal(options.journal);
  return OpenJournalIn(options.journal_folder, state_dir, log);
}

/// Why a coordinator ends.
struct EndOfService {
  std::stop_source end{};            ///< a signal, a command, or the journal was lost
  std::atomic<bool> is_told{false};  ///< by `orbweave stop`
};

/// Those given, with what this process has for the coordinator. All arguments outlive it.
absl::StatusOr<CoordinatorOptions> CompleteOptions(const ServeOptions& options,
                                                   Monitoring& monitoring,
                                                   EndOfService& service) {
  CoordinatorOptions complete = options.coordinator;
  complete.log = monitoring.Log();
  complete.lost = [&service] { service.end.request_stop(); };
  complete.stop = [&service] {
    service.is_told = true;
    service.end.request_stop();
  };
  complete.open_journal = [&](const std::string&) -> absl::StatusOr<std::unique_ptr<Journal>> {
    ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<Journal> journal,
                              OpenJournalOf(options, monitoring.Log()));
    return monitoring.Meter(std::move(journal));
  };
  ORBWEAVE_RETURN_IF_ERROR(options.store.OpenFor(complete));
  return complete;
}

absl::Status Serve(const ServeOptions& options) {
  const StopSignals signals;
  EndOfService service;
  const std::stop_callback on_signal(signals.token(), [&service] { service.end.request_stop(); });
  const SteadyClock clock;
  ORBWEAVE_ASSIGN_OR_RETURN(EventLog file_log, OpenLog(options.coordinator.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto monitoring,
                            Monitoring::Start(options.monitoring, std::move(file_log)));
  const EventLog log = monitoring->Log();
  ORBWEAVE_ASSIGN_OR_RETURN(const CoordinatorOptions coordinator_options,
                            CompleteOptions(options, *monitoring, service));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Coordinator::Open(coordinator_options, clock));
  ServerOptions server_options = options.server;
  server_options.used_tokens_folder = options.coordinator.state_dir + "/used_tokens";
  server_options.roots = options.store.Folders();
  server_options.log = log;
  ORBWEAVE_ASSIGN_OR_RETURN(const auto server,
                            GrpcServer::Start(*coordinator, options.listen, server_options));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto http, monitoring->ServePages(*coordinator, clock));
  ORBWEAVE_RETURN_IF_ERROR(
      Announce(options.announce, server->address(), options.server.tls_folder));
  log({.event = "coordinator_ready",
       .message =
           absl::StrCat("address=", server->address(), " state=", options.coordinator.state_dir)});
  SleepUntilStopped(service.end.get_token());
  ORBWEAVE_RETURN_IF_ERROR(coordinator->health());  // workers stay, for the other coordinator
  // An engine stops it to start it again, here or elsewhere; who presses Ctrl-C, or says so by
  // `orbweave stop`, is done with it.
  const bool is_over = service.is_told || signals.first() == SIGINT;
  coordinator->BeginShutdown(is_over ? Farewell::kDismissWorkers : Farewell::kComeBack);
  log({.event = "coordinator_stops",
       .message = absl::StrCat("its jobs go on when it is started again on the same state; ",
                               is_over ? "its workers are sent home" : "its workers wait for it")});
  if (is_over) {
    TakeBack(options.announce, server->address());
    SeeWorkersOff(*coordinator, options.coordinator.lease_s);
  }
  return absl::OkStatus();
}

}  // namespace

void AddServeCommand(CLI::App& app, SelectedCommand& selected, const PlanLookup& find_plan) {
  CLI::App* command =
      app.add_subcommand("serve", "Run a coordinator: give the tasks of jobs to workers that join");
  const auto options = std::make_shared<ServeOptions>();
  options->coordinator.find_plan = find_plan;
  command->add_option("--listen", options->listen, "unix:/path or host:port (port 0: any free one)")
      ->required();
  command
      ->add_option("--state",
                   options->coordinator.state_dir,
                   "Folder of blobs and of the journal of jobs and results")
      ->required();
  CLI::Option* const journal = command->add_option(
      "--journal",
      options->journal,
      "Address of a PostgreSQL database to keep the journal in, without password "
      "(that is for ~/.pgpass, PGPASSFILE or a service file)");
  command
      ->add_option(
          "--journal-folder",
          options->journal_folder,
          "Folder on a disk of this machine to keep the journal in, where the state folder "
          "is on NFS, Lustre and their like; a copy goes there each minute and at the end")
      ->excludes(journal);
  AddStoreArguments(*command, options->store);
  AddStoreKeysArgument(*command, options->store.keys);
  AddAnnounceArguments(*command, options->announce);
  AddTlsArgument(*command, options->server.tls_folder)
      ->description(
          "Folder with ca.crt, own.crt and own.key of a coordinator (see orbweave keys); "
          "without it only this machine can be served");
  command
      ->add_option("--max-jobs",
                   options->coordinator.max_running_jobs,
                   "Running jobs beyond which no more are taken")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  AddMonitoringArguments(*command, options->monitoring);
  command
      ->add_option("--max-slots",
                   options->coordinator.max_slots,
                   "Slots of workers beyond which /wanted asks for no more; without it: any number")
      ->check(CLI::Range(0, 1'000'000));
  AddLeaseArgument(*command, options->coordinator.lease_s);
  command->footer(
      "Examples:\n"
      "  orbweave serve --listen 127.0.0.1:7000 --state state\n"
      "  orbweave serve --listen unix:/tmp/orbweave.sock --state state --lease 60\n"
      "  orbweave serve --listen 127.0.0.1:7000 --state state --journal postgresql://db/orbweave\n"
      "  orbweave serve --listen 0.0.0.0:7000 --tls keys/coordinator --state state\n"
      "  orbweave serve --listen 0.0.0.0:0 --tls keys/coordinator --state state --announce "
      "shared/coordinator.json\n"
      "  orbweave serve --listen 127.0.0.1:7000 --state state --http 127.0.0.1:9464\n"
      "  orbweave serve --listen 0.0.0.0:7000 --tls keys/coordinator --state state --store "
      "'s3://city-blobs/orbweave?region=eu-central-1' --store-keys store.keys\n"
      "  orbweave serve --listen 127.0.0.1:7000 --state state --root "
      "'city=s3://city-images/2026?region=eu-central-1' --store-keys store.keys\n"
      "Started again on the same state it goes on where it was. The log, one JSON object per line, "
      "goes to stderr and to logs/coordinator.log in the state folder.");
  command->callback([options, &selected] {
    if (!options->store.keys.empty() && !options->store.HasObjects())
      throw CLI::RequiresError("--store-keys", "--store or --root NAME=s3://BUCKET/PREFIX");
    selected.run = [options] { return ReportStatus(Serve(*options)); };
  });
}

}  // namespace orbweave
