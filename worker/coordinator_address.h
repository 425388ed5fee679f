// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"
#include "security/handshake_probe.h"

namespace orbweave {

/// What a coordinator says of itself in a file, so that it is found wherever an engine starts it.
struct Announcement {
  std::string address{};
  std::string fleet{};  ///< empty: it has no TLS
  std::string build{};

  friend bool operator==(const Announcement&, const Announcement&) = default;
};

/// A JSON object on one line; and back. InvalidArgument: no announcement.
[[nodiscard]] std::string AnnouncementToText(const Announcement& announcement);
[[nodiscard]] absl::StatusOr<Announcement> AnnouncementFromText(std::string_view text);

/// Where a coordinator is now, and by what its caller knows it.
struct CoordinatorAddress {
  std::string address{};
  KnownBy known_by = KnownBy::kHost;

  friend bool operator==(const CoordinatorAddress&, const CoordinatorAddress&) = default;
};

/// `named` itself, or, of "@FILE", what the file announces at this moment. Unavailable: there is no
/// such file, or none that says where: the coordinator may not be there yet.
[[nodiscard]] absl::StatusOr<CoordinatorAddress> FindCoordinator(const std::string& named);

}  // namespace orbweave
