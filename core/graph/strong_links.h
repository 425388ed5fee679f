// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/graph/adjacency.h"

namespace orbweave {

/// Which links hold two images together: those of a tenth and more of the weight that the strongest
/// of either image has. A weaker one passes others by, or is of two places that look alike: to
/// reconstruct across it takes the images between.
class StrongLinks {
 public:
  /// `edge_weight`: per edge of `adjacency`, to outlive this.
  StrongLinks(const Adjacency& adjacency, std::span<const double> edge_weight);

  [[nodiscard]] bool Has(uint32_t image, const Adjacency::Link& link) const;

 private:
  std::span<const double> edge_weight_;
  std::vector<double> strongest_;  // per image
};

}  // namespace orbweave
