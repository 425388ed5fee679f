// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/certificate_keeper.h"

#include <utility>

#include "core/base/sleep.h"

namespace orbweave {

bool IsDueForRenewal(const CertificateFacts& certificate, int64_t now_unix_s) {
  constexpr int64_t kShortLived_s = 2 * 86400;
  const int64_t valid_s = certificate.ends_unix_s - certificate.begins_unix_s;
  return valid_s <= kShortLived_s && 3 * (certificate.ends_unix_s - now_unix_s) < valid_s;
}

CertificateKeeper::CertificateKeeper(CertificateKeeperOptions options)
    : options_(std::move(options)), thread_([this](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          Look();
          SleepUnlessStopped(options_.look_s, stop);
        }
      }) {}

void CertificateKeeper::Look() const {
  const absl::StatusOr<CertificateFacts> own = CheckTlsFolder(options_.folder);
  if (own.ok() && !IsDueForRenewal(*own, options_.now_unix_s())) return;
  absl::Status status = own.status();
  if (status.ok()) status = options_.renew();
  if (!options_.log) return;
  if (status.ok()) {
    options_.log({.event = "certificate_renewed", .worker = own->identity.name});
  } else {
    options_.log({.level = LogLevel::kWarning,
                  .event = "certificate_not_renewed",
                  .message = std::string(status.message())});
  }
}

}  // namespace orbweave
