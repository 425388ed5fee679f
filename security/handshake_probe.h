// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "security/tls_folder.h"

namespace orbweave {

/// How a TLS handshake ended.
enum class Handshake {
  kUnclear,        ///< nobody is there, or the connection broke
  kCompleted,      ///< each side took the other's certificate
  kServerRefused,  ///< the caller does not take the server's certificate
  kCallerRefused,  ///< the server, having proven who it is, hung up on the caller's certificate
};

/// By what a caller knows a coordinator, beside its authority.
enum class KnownBy {
  kHost,   ///< its certificate names the host that was called
  kFleet,  ///< it is the certificate of a coordinator of the caller's fleet, wherever it runs
};

/// What a caller shows of its TlsFolder.
enum class Caller {
  kCertified,
  kStranger,  ///< nothing: it has a join token only
};

/// Shakes hands with the coordinator at `address` ("host:port") as a caller with `folder` and hangs
/// up: to find out why calls fail, which gRPC does not tell. Every step waits 2 seconds at most.
[[nodiscard]] Handshake ProbeHandshake(const std::string& address,
                                       const TlsFolder& folder,
                                       Caller caller,
                                       KnownBy known_by = KnownBy::kHost);

}  // namespace orbweave
