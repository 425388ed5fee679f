// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/status.h"

namespace orbweave {
namespace {

// Trials after which samples would come from all data (T_N of the paper): far more than are drawn.
constexpr double kTrialsOfAll = 200000.0;

}  // namespace

void DrawSample(Random& random, uint32_t size, std::span<uint32_t> sample) {
  ORBWEAVE_CHECK(sample.size() <= size);
  for (auto next = sample.begin(); next != sample.end();) {
    *next = random.Index(size);
    if (std::find(sample.begin(), next, *next) == next) ++next;
  }
}

void SampleSource::Draw(std::span<uint32_t> sample) {
  const bool is_ordered = is_ordered_next_ && !best_first_.empty();
  is_ordered_next_ = !is_ordered_next_;
  if (is_ordered) {
    DrawFromBest(sample);
  } else {
    DrawSample(random_, size_, sample);
  }
}

void SampleSource::DrawFromBest(std::span<uint32_t> sample) {
  Grow(sample.size());
  // The last of the best is new: it takes part while its turn lasts.
  const bool takes_last = trial_ <= last_trial_ && num_best_ > sample.size();
  if (takes_last) {
    DrawSample(random_, num_best_ - 1, sample.first(sample.size() - 1));
    sample.back() = num_best_ - 1;
  } else {
    DrawSample(random_, num_best_, sample);
  }
  for (uint32_t& number : sample) number = best_first_[number];
}

void SampleSource::Grow(size_t sample_size) {
  const auto m = static_cast<double>(sample_size);
  if (num_best_ == 0) {
    num_best_ = static_cast<uint32_t>(sample_size);
    expected_trials_ = kTrialsOfAll;
    for (double i = 0.0; i < m; ++i) expected_trials_ *= (m - i) / (size_ - i);
    last_trial_ = 1.0;
  }
  ++trial_;
  if (trial_ <= last_trial_ || num_best_ == size_) return;
  const double n = num_best_;
  const double expected_next = expected_trials_ * (n + 1.0) / (n + 1.0 - m);
  last_trial_ += std::ceil(expected_next - expected_trials_);
  expected_trials_ = expected_next;
  ++num_best_;
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
