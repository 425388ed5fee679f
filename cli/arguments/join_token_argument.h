// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <stop_token>
#include <string>

#include "cli/arguments/coordinator_argument.h"

namespace orbweave {

/// Declares `--token-file`. A token is a secret: it comes from a file, or from the environment
/// variable ORBWEAVE_TOKEN, never from the command line.
void AddJoinTokenArgument(CLI::App& command, std::string& token_path);

/// Who is to have a certificate.
struct Enrolment {
  CoordinatorArgument coordinator{};
  std::string token_path{};  ///< empty: the environment may have one
  std::string name{};
  double patience_s = 0.0;  ///< for a coordinator that does not answer
};

/// Makes the coordinator's TLS folder hold a certificate that is valid now: it is left as it is
/// when it does; otherwise the token (of the file, or without one of the environment) is exchanged,
/// waiting while the coordinator is Unavailable. Does nothing where no token is given. The variable
/// is removed from the environment, so that no child inherits it. InvalidArgument: a token, and no
/// --tls to keep the certificate in. Unauthenticated: see RefusedHandshake. Unavailable: nobody
/// answered in time.
[[nodiscard]] absl::Status EnrolWhereNeeded(const Enrolment& enrolment,
                                            const std::stop_token& stop);

}  // namespace orbweave
