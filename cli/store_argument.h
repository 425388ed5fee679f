// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace orbweave {

/// Adds --store-keys to a command.
inline CLI::Option* AddStoreKeysArgument(CLI::App& command, std::string& path) {
  return command.add_option(
      "--store-keys",
      path,
      "File of mode 0600 with aws_access_key_id, aws_secret_access_key and, where there are such, "
      "aws_session_token and region; without it AWS_ACCESS_KEY_ID and the others in the "
      "environment");
}

}  // namespace orbweave
