// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/random.h"

namespace orbweave {

/// Fills `sample` with different numbers of {0, ..., size-1}, each subset equally likely;
/// sample.size() <= size, and small: quadratic in its length.
void DrawSample(Random& random, uint32_t size, std::span<uint32_t> sample);

/// Samples of data of which some are likelier to be inliers: every other one is drawn from all data
/// alike, those between from the best few, which grow with every trial (Chum and Matas, Matching
/// with PROSAC, CVPR 2005). Where one match in ten is right and the order tells which, a sample of
/// right ones comes within hundreds of trials instead of a hundred thousand; where it tells
/// nothing, or look-alikes come first, half of the trials are as without it.
class SampleSource {
 public:
  /// `best_first`: all data; empty where no order is known: then every sample is drawn alike.
  SampleSource(uint64_t seed, uint32_t size, std::span<const uint32_t> best_first)
      : random_(seed), size_(size), best_first_(best_first) {}

  /// Fills `sample`, of the same length each time, with different numbers of {0, ..., size-1}.
  void Draw(std::span<uint32_t> sample);

 private:
  void DrawFromBest(std::span<uint32_t> sample);
  void Grow(size_t sample_size);

  Random random_;
  uint32_t size_ = 0;
  std::span<const uint32_t> best_first_;
  bool is_ordered_next_ = true;
  uint32_t num_best_ = 0;         // n
  double expected_trials_ = 0.0;  // T_n
  double last_trial_ = 0.0;       // T'_n
  double trial_ = 0.0;
};

/// The numbers 0 ... size-1 in random order (Fisher and Yates).
[[nodiscard]] std::vector<uint32_t> ShuffledOrder(uint32_t size, uint64_t seed);

/// Trials after which a sample of `sample_size` inliers was drawn with probability `confidence`:
/// log(1 - confidence) / log(1 - share^sample_size), in [1, max_trials].
[[nodiscard]] int RequiredTrials(double inlier_share,
                                 size_t sample_size,
                                 double confidence,
                                 int max_trials);

}  // namespace orbweave
