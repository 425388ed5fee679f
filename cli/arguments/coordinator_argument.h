// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/base/status.h"
#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// How long a command waits for a coordinator that is away, in seconds: one that only asks, and one
/// that waits for a job.
inline constexpr double kAskPatience_s = 10.0;
inline constexpr double kJobPatience_s = 600.0;

/// How a command reaches a coordinator.
struct CoordinatorArgument {
  std::string address{};
  std::string tls_folder{};            ///< empty: no TLS
  std::optional<double> patience_s{};  ///< for a coordinator that is away

  /// OK when the TLS folder, if one is named, is whole; else what is wrong with it.
  [[nodiscard]] absl::Status Check() const;
};

/// Declares `--coordinator`, `--tls` and `--patience`.
void AddCoordinatorArgument(CLI::App& command, CoordinatorArgument& argument);

/// Declares `--join` and `--tls`: a worker waits for its coordinator without end.
void AddJoinArgument(CLI::App& command, CoordinatorArgument& argument);

/// Declares `--tls` alone.
CLI::Option* AddTlsArgument(CLI::App& command, std::string& tls_folder);

/// What a client of the coordinator needs besides.
struct ConnectOptions {
  double patience_s = kAskPatience_s;          ///< unless the command line says otherwise
  std::stop_token stop{};                      ///< ends calls that wait for a coordinator
  std::map<std::string, std::string> roots{};  ///< as in ClientOptions
};

/// The coordinator, whose absence is waited through (PatientCoordinator) and told on stderr; errors
/// of calls name its address. InvalidArgument, NotFound: the TLS folder is not whole.
[[nodiscard]] absl::StatusOr<std::unique_ptr<ClientApi>> Connect(
    const CoordinatorArgument& argument, const ConnectOptions& options = {});

}  // namespace orbweave
