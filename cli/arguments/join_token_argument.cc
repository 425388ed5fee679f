// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/join_token_argument.h"

#include <chrono>
#include <cstdlib>

#include "absl/strings/ascii.h"
#include "cli/process/event_log.h"
#include "security/secret_file.h"
#include "security/tls_folder.h"
#include "security/unix_time.h"
#include "worker/grpc_enrollment_client.h"
#include "worker/refused_handshake.h"
#include "worker/retry.h"

namespace orbweave {
namespace {

constexpr char kVariable[] = "ORBWEAVE_TOKEN";

/// Empty: none is given.
absl::StatusOr<std::string> TakeToken(const std::string& path) {
  const char* variable = std::getenv(kVariable);
  std::string token = variable == nullptr ? "" : variable;
  ::unsetenv(kVariable);
  if (!path.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(token, ReadSecretFile(path));
  }
  return std::string(absl::StripAsciiWhitespace(token));
}

bool HasValidCertificate(const TlsFolder& folder) {
  const absl::StatusOr<CertificateFacts> own = CheckTlsFolder(folder);
  return own.ok() && UnixNow() < own->ends_unix_s;
}

}  // namespace

void AddJoinTokenArgument(CLI::App& command, std::string& token_path) {
  command.add_option("--token-file",
                     token_path,
                     "File with a join token (see orbweave keys token), exchanged for a "
                     "certificate that is kept in the folder of --tls; or set ORBWEAVE_TOKEN");
}

absl::Status EnrolWhereNeeded(const Enrolment& enrolment, const std::stop_token& stop) {
  using Steady = std::chrono::steady_clock;
  const CoordinatorArgument& coordinator = enrolment.coordinator;
  const TlsFolder folder{coordinator.tls_folder};
  const bool is_enrolled = !folder.path.empty() && HasValidCertificate(folder);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string token,
                            TakeToken(is_enrolled ? "" : enrolment.token_path));
  if (token.empty() || is_enrolled) return absl::OkStatus();
  if (folder.path.empty()) {
    return absl::InvalidArgumentError(
        "a join token needs --tls: the folder to keep the certificate in");
  }
  RefusedHandshake handshake(coordinator.address, folder.path, Caller::kStranger);
  const auto say = [&, began = Steady::now()](const absl::Status& why) {
    LogToStderr({.level = LogLevel::kWarning,
                 .event = "coordinator_away",
                 .message = std::string(why.message())});
    const std::chrono::duration<double> waited = Steady::now() - began;
    return waited.count() < enrolment.patience_s;
  };
  return Retry({.stop = stop, .goes_on = say}, [&] {
    return handshake.Explain(Enroll(coordinator.address, token, enrolment.name, folder));
  });
}

}  // namespace orbweave
