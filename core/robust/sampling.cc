// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/status.h"

namespace orbweave {

void DrawSample(Random& random, uint32_t size, std::span<uint32_t> sample) {
  ORBWEAVE_CHECK(sample.size() <= size);
  for (auto next = sample.begin(); next != sample.end();) {
    *next = random.Index(size);
    if (std::find(sample.begin(), next, *next) == next) ++next;
  }
}

std::vector<uint32_t> ShuffledOrder(uint32_t size, uint64_t seed) {
  std::vector<uint32_t> order(size);
  std::iota(order.begin(), order.end(), 0U);
  Random random(~seed);  // not the numbers that samples are drawn with
  for (uint32_t i = size; i > 1; --i) std::swap(order[i - 1], order[random.Index(i)]);
  return order;
}

int RequiredTrials(double inlier_share, size_t sample_size, double confidence, int max_trials) {
  const double success = std::pow(inlier_share, static_cast<double>(sample_size));
  if (success >= 1.0) return 1;
  const double trials = std::log1p(-confidence) / std::log1p(-success);  // infinite for success = 0
  if (!(trials < max_trials)) return max_trials;
  return std::max(1, static_cast<int>(std::ceil(trials)));
}

}  // namespace orbweave
