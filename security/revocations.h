// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "security/certificate.h"

namespace orbweave {

/// Whom a fleet has shut out before their certificates end, and which join tokens before they
/// expire.
struct Revocations {
  std::set<std::string> names{};    ///< whatever certificate they show
  std::set<std::string> serials{};  ///< of single certificates; see CertificateFacts
  std::set<std::string> tokens{};   ///< nonces of join tokens; see JoinClaims

  friend bool operator==(const Revocations&, const Revocations&) = default;
};

/// One "name NAME", "serial DIGITS" or "token DIGITS" per line, in order; and back.
/// InvalidArgument: any other line.
[[nodiscard]] std::string RevocationsToText(const Revocations& revoked);
[[nodiscard]] absl::StatusOr<Revocations> RevocationsFromText(std::string_view text);

/// The same from a file of mode 0600; nobody is revoked where there is none.
[[nodiscard]] absl::StatusOr<Revocations> ReadRevocations(const std::string& path);

/// A file of revocations that may change at any time. Thread-safe.
class RevocationList {
 public:
  using OnUnreadable = std::function<void(const absl::Status&)>;

  /// As ReadRevocations. Later, while the file cannot be read, what it said last counts, and
  /// `on_unreadable` hears of it once.
  [[nodiscard]] static absl::StatusOr<std::shared_ptr<RevocationList>> Open(
      const std::string& path, OnUnreadable on_unreadable);

  /// PermissionDenied when the file, as it is now, names this certificate (PEM) or its holder.
  [[nodiscard]] absl::Status Check(const Identity& holder, std::string_view certificate_pem);
  /// PermissionDenied when the file, as it is now, names the join token of this nonce.
  [[nodiscard]] absl::Status CheckToken(const std::string& nonce);

 private:
  RevocationList(const std::string& path, OnUnreadable on_unreadable)
      : path_(path), on_unreadable_(std::move(on_unreadable)) {}
  /// Reads the file where it has changed.
  [[nodiscard]] absl::Status Refresh();
  void RefreshOrTell();

  const std::string path_;
  const OnUnreadable on_unreadable_;
  std::mutex mutex_;
  std::string state_{"not read"};  ///< of the file when it was read; see StateOf
  Revocations revoked_{};
};

}  // namespace orbweave
