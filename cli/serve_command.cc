// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/serve_command.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "absl/strings/str_cat.h"
#include "cli/coordinator_argument.h"
#include "cli/exit_code.h"
#include "cli/log_line.h"
#include "cli/root_argument.h"
#include "cli/stop_signals.h"
#include "coordinator/coordinator.h"
#include "coordinator/grpc_server.h"
#include "coordinator/postgres_journal.h"

namespace orbweave {
namespace {

struct ServeOptions {
  std::string listen{};
  std::string journal{};  ///< of a PostgreSQL database; empty: in the state folder
  ServerOptions server{};
  CoordinatorOptions coordinator{};
};

void WaitForStop(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait(lock, stop, [] { return false; });
}

absl::Status Serve(const ServeOptions& options) {
  const StopSignals signals;
  ServerOptions server_options = options.server;
  server_options.used_tokens_folder = options.coordinator.state_dir + "/used_tokens";
  const SteadyClock clock;
  CoordinatorOptions with_journal = options.coordinator;
  if (!options.journal.empty()) {
    with_journal.open_journal = [&options](const std::string&) {
      return OpenPostgresJournal(options.journal);
    };
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Coordinator::Open(with_journal, clock));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto server,
                            GrpcServer::Start(*coordinator, options.listen, server_options));
  LogLine(absl::StrCat(
      "coordinator ready address=", server->address(), " state=", options.coordinator.state_dir));
  WaitForStop(signals.token());
  coordinator->BeginShutdown();
  LogLine("coordinator stops; its jobs go on when it is started again on the same state");
  return absl::OkStatus();
}

}  // namespace

void AddServeCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command =
      app.add_subcommand("serve", "Run a coordinator: give the tasks of jobs to workers that join");
  const auto options = std::make_shared<ServeOptions>();
  options->coordinator.log = LogLine;
  options->server.log = LogLine;
  command->add_option("--listen", options->listen, "unix:/path or host:port (port 0: any free one)")
      ->required();
  command
      ->add_option("--state",
                   options->coordinator.state_dir,
                   "Folder of blobs and of the journal of jobs and results")
      ->required();
  command->add_option("--journal",
                      options->journal,
                      "Address of a PostgreSQL database to keep the journal in, without password "
                      "(that is for ~/.pgpass, PGPASSFILE or a service file)");
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
  AddRootArgument(*command,
                  options->server.roots,
                  "Folder beneath which clients may name images, instead of sending them "
                  "(repeatable)");
  command
      ->add_option("--lease",
                   options->coordinator.lease_s,
                   "Seconds of silence after which a worker is given up")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  orbweave serve --listen 127.0.0.1:7000 --state state\n"
      "  orbweave serve --listen unix:/tmp/orbweave.sock --state state --lease 60\n"
      "  orbweave serve --listen 127.0.0.1:7000 --state state --journal postgresql://db/orbweave\n"
      "  orbweave serve --listen 0.0.0.0:7000 --tls keys/coordinator --state state\n"
      "Started again on the same state it goes on where it was.");
  command->callback(
      [options, &selected] { selected.run = [options] { return ReportStatus(Serve(*options)); }; });
}

}  // namespace orbweave
