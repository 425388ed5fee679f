// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <thread>

#include "core/pipeline/log_event.h"
#include "security/certificate.h"
#include "security/tls_folder.h"
#include "security/unix_time.h"

namespace orbweave {

/// Whether a certificate is one that is to be renewed (valid for two days or less: longer ones are
/// somebody's decision) and less than a third of its time is left.
[[nodiscard]] bool IsDueForRenewal(const CertificateFacts& certificate, int64_t now_unix_s);

struct CertificateKeeperOptions {
  TlsFolder folder{};
  double look_s = 60.0;  ///< between two looks at the certificate, and two attempts to renew it
  UnixClock now_unix_s = UnixNow;
  /// Replaces the folder's certificate.
  std::function<absl::Status()> renew{};
  EventLog log{};  ///< told of every renewal and failure
};

/// While it lives, a thread of its own renews a folder's certificate before it ends.
class CertificateKeeper {
 public:
  explicit CertificateKeeper(CertificateKeeperOptions options);

 private:
  void Look() const;

  CertificateKeeperOptions options_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
