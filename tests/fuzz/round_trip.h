// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

[[nodiscard]] inline std::string_view BytesOf(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// The law of a codec: what `decode` takes, `encode` turns into bytes that mean the same, as often
/// as one likes. (The bytes given need not be those: fields may come in any order.)
template <typename Decode, typename Encode>
void CheckRoundTrip(std::string_view bytes, Decode decode, Encode encode) {
  const auto value = decode(bytes);
  if (!value.ok()) return;
  const absl::StatusOr<std::string> encoded = encode(*value);
  ORBWEAVE_CHECK(encoded.ok());
  const auto again = decode(*encoded);
  ORBWEAVE_CHECK(again.ok());
  ORBWEAVE_CHECK(absl::StatusOr<std::string>(encode(*again)).value() == *encoded);
}

}  // namespace orbweave
