// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

#include "cli/arguments/store_argument.h"
#include "cli/fleet/local_fleet.h"
#include "cli/fleet/monitoring.h"
#include "core/base/status.h"

namespace orbweave {

/// Who does the tasks of a job that this process coordinates.
struct FleetArgument {
  uint32_t workers = 2;          ///< processes of this machine
  FleetDoor door{};              ///< for workers of others
  std::string journal_folder{};  ///< see LocalFleetOptions
  StoreArgument store{};
  MonitoringArgument monitoring{};
  double lease_s = kDefaultLease_s;

  /// InvalidArgument: there would be nobody.
  [[nodiscard]] absl::Status Check() const;
};

/// Declares `--workers`, `--listen`, `--tls`, `--announce` and `--announce-host`, `--lease`,
/// `--journal-folder`, those of AddStoreArguments (and `--store-keys`, unless the command has it
/// for its images: then its value goes to `store.keys` as well) and of AddMonitoringArguments.
void AddFleetArguments(CLI::App& command, FleetArgument& argument);

/// Declares `--lease` alone.
void AddLeaseArgument(CLI::App& command, double& lease_s);

}  // namespace orbweave
