// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <limits>

namespace orbweave {

/// An index that cannot be mixed up with an index of another kind.
/// `StrongId<struct ImageTag>` and `StrongId<struct TrackTag>` do not convert into each other.
template <typename Tag>
struct StrongId {
  static constexpr uint32_t kInvalidValue = std::numeric_limits<uint32_t>::max();

  uint32_t value = kInvalidValue;

  constexpr StrongId() = default;
  constexpr explicit StrongId(uint32_t v) : value(v) {}

  [[nodiscard]] constexpr bool IsValid() const { return value != kInvalidValue; }
  friend constexpr auto operator<=>(const StrongId&, const StrongId&) = default;
};

}  // namespace orbweave

template <typename Tag>
struct std::hash<orbweave::StrongId<Tag>> {
  size_t operator()(const orbweave::StrongId<Tag>& id) const noexcept {
    return std::hash<uint32_t>{}(id.value);
  }
};
