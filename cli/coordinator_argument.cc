// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/coordinator_argument.h"

#include "security/tls_folder.h"

namespace orbweave {

absl::Status CoordinatorArgument::Check() const {
  return tls_folder.empty() ? absl::OkStatus() : CheckTlsFolder({tls_folder}).status();
}

void AddCoordinatorArgument(CLI::App& command,
                            CoordinatorArgument& argument,
                            const std::string& flag) {
  command.add_option(flag, argument.address, "Address of the coordinator")->required();
  AddTlsArgument(command, argument.tls_folder);
}

CLI::Option* AddTlsArgument(CLI::App& command, std::string& tls_folder) {
  return command.add_option(
      "--tls", tls_folder, "Folder with ca.crt, own.crt and own.key (see orbweave keys)");
}

}  // namespace orbweave
