// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/base/status.h"

namespace orbweave {

/// How a command reaches a coordinator.
struct CoordinatorArgument {
  std::string address{};
  std::string tls_folder{};  ///< empty: no TLS

  /// OK when the TLS folder, if one is named, is whole; else what is wrong with it.
  [[nodiscard]] absl::Status Check() const;
};

/// Declares `--coordinator` (or `flag`) and `--tls`.
void AddCoordinatorArgument(CLI::App& command,
                            CoordinatorArgument& argument,
                            const std::string& flag = "--coordinator");

/// Declares `--tls` alone.
CLI::Option* AddTlsArgument(CLI::App& command, std::string& tls_folder);

}  // namespace orbweave
