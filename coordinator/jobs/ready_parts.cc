// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/ready_parts.h"

#include <iterator>

namespace orbweave {

bool ReadyParts::Contains(uint32_t part) const {
  const auto after = ends_.upper_bound(part);
  return after != ends_.begin() && part < std::prev(after)->second;
}

void ReadyParts::Insert(uint32_t part) {
  if (Contains(part)) return;
  const auto after = ends_.upper_bound(part);
  const bool touches_after = after != ends_.end() && after->first == part + 1;
  const uint32_t end = touches_after ? after->second : part + 1;
  const bool touches_before = after != ends_.begin() && std::prev(after)->second == part;
  if (touches_before) {
    std::prev(after)->second = end;
  } else {
    ends_.emplace(part, end);
  }
  if (touches_after) ends_.erase(after);
}

bool ReadyParts::Erase(uint32_t part) {
  if (!Contains(part)) return false;
  const auto it = std::prev(ends_.upper_bound(part));
  const auto [first, end] = *it;
  if (part + 1 < end) ends_.emplace(part + 1, end);
  if (first < part) {
    it->second = part;
  } else {
    ends_.erase(it);
  }
  return true;
}

ReadyParts::Stretch ReadyParts::Longest() const {
  Stretch longest;
  for (const auto& [first, end] : ends_) {
    if (end - first > longest.size()) longest = {first, end};
  }
  return longest;
}

}  // namespace orbweave
