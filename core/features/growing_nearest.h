// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/features/nearest_two.h"
#include "core/features/pair_side.h"

namespace orbweave {

/// The nearest descriptors among the largest features of two panoramas, of more and more of them:
/// large features are found again from further away, and fewer of them look alike. What was
/// compared is not compared again, so that all together cost what FindNearestTwo costs.
class GrowingNearest {
 public:
  /// Both sides outlive this.
  GrowingNearest(const PairSide& a, const PairSide& b);

  /// Compares the `count` largest of either side, or all where it has fewer.
  void GrowTo(size_t count);

  [[nodiscard]] bool HasAll() const;
  /// Of all features, by index. Those that were not compared have kNoDistance.
  [[nodiscard]] NearestTwoBothWays Nearest() const;

 private:
  struct Range {
    size_t begin = 0;
    size_t end = 0;
  };
  void Compare(Range of_a, Range of_b);

  const PairSide& a_;
  const PairSide& b_;
  size_t num_a_ = 0;            ///< compared
  size_t num_b_ = 0;            ///< compared
  NearestTwoBothWays nearest_;  ///< by scale
};

}  // namespace orbweave
