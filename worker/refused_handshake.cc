// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/refused_handshake.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "security/unix_time.h"
#include "worker/coordinator_address.h"

namespace orbweave {
namespace {

constexpr int kEnough = 3;
constexpr std::chrono::seconds kBetweenLooks{1};

bool HasEnded(const TlsFolder& folder) {
  const absl::StatusOr<CertificateFacts> own = CheckTlsFolder(folder);
  return own.ok() && UnixNow() >= own->ends_unix_s;
}

}  // namespace

RefusedHandshake::RefusedHandshake(std::string address, std::string tls_folder, Caller caller)
    : address_(std::move(address)), tls_folder_(std::move(tls_folder)), caller_(caller) {}

absl::Status RefusedHandshake::Explain(const absl::Status& status) {
  if (!absl::IsUnavailable(status) || tls_folder_.empty()) return status;
  const std::unique_lock lock(mutex_, std::try_to_lock);  // somebody else may be looking
  if (!lock.owns_lock() || std::chrono::steady_clock::now() < next_look_) return status;
  const absl::Status refused = Look();
  next_look_ = std::chrono::steady_clock::now() + kBetweenLooks;
  return refused.ok() ? status : refused;
}

absl::Status RefusedHandshake::Look() {
  const absl::StatusOr<CoordinatorAddress> to = FindCoordinator(address_);
  if (!to.ok() || to->address.starts_with("unix:")) return absl::OkStatus();
  if (caller_ == Caller::kCertified && HasEnded({tls_folder_})) {
    return absl::UnauthenticatedError(absl::StrCat(
        "the certificate in ", tls_folder_, " has ended: renew it, or join by a new token"));
  }
  const Handshake outcome = ProbeHandshake(to->address, {tls_folder_}, caller_, to->known_by);
  const bool is_refusal =
      outcome == Handshake::kServerRefused || outcome == Handshake::kCallerRefused;
  refusals_ = is_refusal ? refusals_ + 1 : 0;
  if (refusals_ < kEnough) return absl::OkStatus();
  if (outcome == Handshake::kCallerRefused && caller_ == Caller::kStranger) {
    return absl::UnauthenticatedError(
        absl::StrCat("the coordinator at ", address_, " takes certificates only, no join tokens"));
  }
  if (outcome == Handshake::kCallerRefused) {
    return absl::UnauthenticatedError(absl::StrCat("the coordinator at ",
                                                   address_,
                                                   " refuses the certificate in ",
                                                   tls_folder_,
                                                   ": it is of another authority, or has ended"));
  }
  return absl::UnauthenticatedError(
      absl::StrCat("the certificate of the coordinator at ",
                   address_,
                   " is refused: it has ended, is not for that host, or not by the authority in ",
                   tls_folder_));
}

}  // namespace orbweave
