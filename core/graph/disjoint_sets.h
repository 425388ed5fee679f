// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace orbweave {

/// Union-find over 0 ... n-1 with union by size and path halving; amortised near-constant time.
/// Tarjan, Efficiency of a good but not linear set union algorithm, JACM 1975.
class DisjointSets {
 public:
  explicit DisjointSets(uint32_t n) : parent_(n), size_(n, 1) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// The representative of the set of x.
  [[nodiscard]] uint32_t Find(uint32_t x) {
    while (parent_[x] != x) {
      parent_[x] = parent_[parent_[x]];
      x = parent_[x];
    }
    return x;
  }

  /// Joins the sets of x and y; false when they were one already.
  bool Unite(uint32_t x, uint32_t y) {
    x = Find(x);
    y = Find(y);
    if (x == y) return false;
    if (size_[x] < size_[y]) std::swap(x, y);
    parent_[y] = x;
    size_[x] += size_[y];
    return true;
  }

  /// Number of elements in the set of x.
  [[nodiscard]] uint32_t SizeOf(uint32_t x) { return size_[Find(x)]; }

  /// Some elements by the sets that they are in, each list ascending: the one of most elements
  /// first, of lists of as many that of the lowest element.
  [[nodiscard]] std::vector<std::vector<uint32_t>> SetsOf(std::vector<uint32_t> elements) {
    std::ranges::sort(elements);
    std::map<uint32_t, std::vector<uint32_t>> list_of;
    for (const uint32_t element : elements) list_of[Find(element)].push_back(element);
    std::vector<std::vector<uint32_t>> lists;
    for (auto& [representative, list] : list_of) lists.push_back(std::move(list));
    std::ranges::sort(lists, [](const auto& x, const auto& y) {
      return std::pair(y.size(), x.front()) < std::pair(x.size(), y.front());
    });
    return lists;
  }

 private:
  std::vector<uint32_t> parent_;
  std::vector<uint32_t> size_;
};

}  // namespace orbweave
