// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "objects/http_client.h"
#include "objects/object_store.h"

namespace orbweave {

/// Reads the object that `grant` gives the right to, or a range of it, in pieces, unverified. What
/// does not come to its end is gone on with where it ended, a few times, with waits between.
/// Errors of StatusOfS3 and of `take`. `what` names it in errors.
[[nodiscard]] absl::Status ReadGranted(HttpClient& http,
                                       const ObjectGrant& grant,
                                       const std::optional<ByteRange>& range,
                                       const std::string& what,
                                       const TakePiece& take);

/// Stores the object that `grant` gives the right to; OK also when there is one already. Tried
/// once: the pieces come once. Errors of StatusOfS3 and of `next`.
[[nodiscard]] absl::Status WriteGranted(HttpClient& http,
                                        const ObjectGrant& grant,
                                        uint64_t size_bytes,
                                        const std::string& what,
                                        const NextPiece& next);

/// Stores the part that `grant` gives the right to; the tag by which the server knows it. Errors of
/// StatusOfS3; DataLoss also: the server gives no tag.
[[nodiscard]] absl::StatusOr<std::string> WriteGrantedPart(HttpClient& http,
                                                           const ObjectGrant& grant,
                                                           std::string_view bytes,
                                                           const std::string& what);

/// The time before attempt number `attempt` (from 1 on) after a failure that may pass: a tenth of a
/// second, doubled each time, times a random number from 0.5 to 1.5, so that many who failed
/// together do not come back together.
[[nodiscard]] double PauseBefore_s(int attempt);

/// How often something is tried.
inline constexpr int kMostAttempts = 6;

}  // namespace orbweave
