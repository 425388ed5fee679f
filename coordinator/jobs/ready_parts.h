// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace orbweave {

/// The parts of a stage that are ready, as stretches of consecutive ones. Every call takes time
/// that grows with the number of stretches at most, not with that of parts.
class ReadyParts {
 public:
  /// Parts `first` to `end`, without `end`.
  struct Stretch {
    uint32_t first = 0;
    uint32_t end = 0;
    [[nodiscard]] uint32_t size() const { return end - first; }
  };

  void Insert(uint32_t part);
  /// Whether it was there.
  bool Erase(uint32_t part);

  [[nodiscard]] bool Contains(uint32_t part) const;
  [[nodiscard]] bool empty() const { return ends_.empty(); }
  /// The first of the longest ones; of no size when there is none.
  [[nodiscard]] Stretch Longest() const;
  /// The first part for which `predicate` holds, in order.
  template <typename Predicate>
  [[nodiscard]] std::optional<uint32_t> FindFirst(Predicate predicate) const {
    for (const auto& [first, end] : ends_) {
      for (uint32_t part = first; part < end; ++part) {
        if (predicate(part)) return part;
      }
    }
    return std::nullopt;
  }

 private:
  std::map<uint32_t, uint32_t> ends_;  ///< of stretches that do not touch, by their first part
};

}  // namespace orbweave
