// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "security/certificate.h"

namespace orbweave {

/// The folder that `--tls` names: all that a process needs to prove who it is and to check others.
struct TlsFolder {
  std::string path{};

  /// Who may certify: PEM of one or more authorities.
  [[nodiscard]] std::string AuthorityPath() const { return path + "/ca.crt"; }
  /// The process's own certificate, and the chain behind it, and its private key.
  [[nodiscard]] std::string CertificatePath() const { return path + "/own.crt"; }
  [[nodiscard]] std::string KeyPath() const { return path + "/own.key"; }
  /// Whom a coordinator no longer takes, see Revocations; need not be there.
  [[nodiscard]] std::string RevocationsPath() const { return path + "/revoked"; }
  /// With these two, a coordinator takes join tokens: the authority's key and MakeTokenKey's.
  [[nodiscard]] std::string AuthorityKeyPath() const { return path + "/ca.key"; }
  [[nodiscard]] std::string TokenKeyPath() const { return path + "/token.key"; }
};

/// What the folder's own certificate says. NotFound: a file is missing. PermissionDenied: a key is
/// open to others. InvalidArgument: no certificate, no identity in it, or the key of another one.
[[nodiscard]] absl::StatusOr<CertificateFacts> CheckTlsFolder(const TlsFolder& folder);

}  // namespace orbweave
