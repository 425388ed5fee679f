// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/fleet_argument.h"

#include "cli/arguments/coordinator_argument.h"

namespace orbweave {

absl::Status FleetArgument::Check() const {
  if (workers > 0 || !door.listen.empty()) return absl::OkStatus();
  return absl::InvalidArgumentError("--workers 0 needs --listen: somebody else has to do the work");
}

void AddFleetArguments(CLI::App& command, FleetArgument& argument) {
  command.add_option("--workers", argument.workers, "Worker processes of this machine")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  CLI::Option* const listen = command.add_option(
      "--listen",
      argument.door.listen,
      "Also take workers that join here (orbweave work --join): unix:/path or host:port");
  AddTlsArgument(command, argument.door.tls_folder)
      ->description("With --listen: folder with ca.crt, own.crt and own.key of a coordinator")
      ->needs(listen);
  AddAnnounceArguments(command, argument.door.announce);
  command.add_option("--journal-folder",
                     argument.journal_folder,
                     "Folder on a disk of this machine to keep the journal in, with a copy in the "
                     "output (default: only where that is on NFS, Lustre and their like)");
  AddStoreArguments(command, argument.store);
  if (command.get_option_no_throw("--store-keys") == nullptr)
    AddStoreKeysArgument(command, argument.store.keys);
  AddLeaseArgument(command, argument.lease_s);
  AddMonitoringArguments(command, argument.monitoring);
}

void AddLeaseArgument(CLI::App& command, double& lease_s) {
  command.add_option("--lease", lease_s, "Seconds of silence after which a worker is given up")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
}

}  // namespace orbweave
