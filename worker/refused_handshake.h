// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "core/base/status.h"
#include "security/handshake_probe.h"

namespace orbweave {

/// Tells a coordinator that is away from one with whom no handshake will ever succeed: gRPC says of
/// both that they are unavailable. Thread-safe.
class RefusedHandshake {
 public:
  /// `address`: see FindCoordinator. `tls_folder` empty: there are no handshakes.
  RefusedHandshake(std::string address, std::string tls_folder, Caller caller = Caller::kCertified);

  /// `status` of a call as it is; but instead of Unavailable Unauthenticated, with what to do, when
  /// the caller's certificate has ended, or three probes on end, a second apart at least, found
  /// that one side refuses the other's certificate.
  [[nodiscard]] absl::Status Explain(const absl::Status& status);

 private:
  [[nodiscard]] absl::Status Look();

  const std::string address_;
  const std::string tls_folder_;
  const Caller caller_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point next_look_{};
  int refusals_ = 0;  ///< on end
};

}  // namespace orbweave
