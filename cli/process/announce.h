// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/base/status.h"

namespace orbweave {

/// Where a coordinator says where it is.
struct AnnounceArgument {
  std::string path{};  ///< empty: nowhere
  std::string host{};  ///< by which others reach it; empty: that of the address, or this machine's
};

/// Declares `--announce` and `--announce-host`.
void AddAnnounceArguments(CLI::App& command, AnnounceArgument& argument);

/// Writes the file, whole from its first moment on: a coordinator listens at `address` (as the
/// server prints it) with the certificate in `tls_folder` (empty: none). Errors of the disk and of
/// CheckTlsFolder.
[[nodiscard]] absl::Status Announce(const AnnounceArgument& argument,
                                    const std::string& address,
                                    const std::string& tls_folder);

/// It is not coming back: removes the file, unless another coordinator has announced itself there.
void TakeBack(const AnnounceArgument& argument, const std::string& address);

}  // namespace orbweave
