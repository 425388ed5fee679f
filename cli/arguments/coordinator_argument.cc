// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/coordinator_argument.h"

#include <cstdio>

#include "absl/strings/str_cat.h"
#include "cli/fleet/patient_coordinator.h"
#include "security/tls_folder.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

void AddAddress(CLI::App& command, CoordinatorArgument& argument, const std::string& flag) {
  command
      .add_option(flag,
                  argument.address,
                  "Address of the coordinator, or @FILE that orbweave serve --announce writes")
      ->required();
  AddTlsArgument(command, argument.tls_folder);
}

}  // namespace

absl::Status CoordinatorArgument::Check() const {
  return tls_folder.empty() ? absl::OkStatus() : CheckTlsFolder({tls_folder}).status();
}

void AddCoordinatorArgument(CLI::App& command, CoordinatorArgument& argument) {
  AddAddress(command, argument, "--coordinator");
  command
      .add_option("--patience",
                  argument.patience_s,
                  absl::StrCat("Seconds to wait for a coordinator that does not answer (default: ",
                               kAskPatience_s,
                               ", or ",
                               kJobPatience_s,
                               " to submit or watch a job); then the exit code is 3"))
      ->check(CLI::NonNegativeNumber);
}

void AddJoinArgument(CLI::App& command, CoordinatorArgument& argument) {
  AddAddress(command, argument, "--join");
}

CLI::Option* AddTlsArgument(CLI::App& command, std::string& tls_folder) {
  return command.add_option(
      "--tls", tls_folder, "Folder with ca.crt, own.crt and own.key (see orbweave keys)");
}

absl::StatusOr<std::unique_ptr<ClientApi>> Connect(const CoordinatorArgument& argument,
                                                   const ConnectOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(argument.Check());
  const double patience_s = argument.patience_s.value_or(options.patience_s);
  const auto say = [patience_s](const absl::Status& away) {
    const std::string message(away.message());
    std::fprintf(stderr, "orbweave: %s; waiting up to %g s\n", message.c_str(), patience_s);
  };
  return std::make_unique<PatientCoordinator>(
      std::make_unique<GrpcCoordinatorClient>(
          argument.address,
          ClientOptions{.tls_folder = argument.tls_folder, .roots = options.roots}),
      Patience{
          .address = argument.address, .wait_s = patience_s, .stop = options.stop, .on_away = say});
}

}  // namespace orbweave
