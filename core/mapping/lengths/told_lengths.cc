// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/told_lengths.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/mapping/lengths/log_length_of_pair.h"

namespace orbweave {
namespace {

constexpr double kMaxRays = 50.0;
constexpr size_t kModes = 2;

/// Of ascending logarithms those that agree closely with one.
std::span<const double> CloseTo(std::span<const double> sorted, double log_length) {
  const auto first = std::ranges::lower_bound(sorted, log_length - kCloseTolerance);
  const auto last = std::ranges::upper_bound(sorted, log_length + kCloseTolerance);
  return {first, last};
}

/// The middle of the interval of agreeing values that holds most of them; the first of several.
double DensestOf(std::span<const double> sorted) {
  double mode = 0.0;
  ptrdiff_t most = 0;
  for (auto first = sorted.begin(); first != sorted.end(); ++first) {
    const auto last = std::upper_bound(first, sorted.end(), *first + 2.0 * kCloseTolerance);
    if (last - first <= most) continue;
    most = last - first;
    mode = 0.5 * (*first + *(last - 1));
  }
  return mode;
}

}  // namespace

ToldLengths::ToldLengths(const Eigen::Vector3d& direction, std::vector<double> log_lengths)
    : direction_(direction), log_lengths_(std::move(log_lengths)) {
  std::ranges::sort(log_lengths_);
}

double ToldLengths::CountAgreeing(const Eigen::Vector3d& step) const {
  const double length = step.norm();
  if (!(length > 0.0) || step.dot(direction_) < kMinCosDirection * length) return 0.0;
  const auto count = static_cast<double>(CloseTo(log_lengths_, std::log(length)).size());
  return count * std::min(1.0, kMaxRays / static_cast<double>(log_lengths_.size()));
}

std::vector<double> ToldLengths::Modes() const {
  std::vector<double> left = log_lengths_;
  std::vector<double> modes;
  while (modes.size() < kModes && !left.empty()) {
    const double mode = DensestOf(left);
    modes.push_back(std::exp(mode));
    std::erase_if(left, [mode](double each) { return std::abs(each - mode) <= kCloseTolerance; });
  }
  return modes;
}

std::optional<double> ToldLengths::ModeWithin(double shortest, double longest) const {
  const auto first = std::ranges::lower_bound(log_lengths_, std::log(shortest));
  const auto last = std::ranges::upper_bound(log_lengths_, std::log(longest));
  if (first >= last) return std::nullopt;
  return std::exp(DensestOf({first, last}));
}

std::vector<double> ToldLengths::Near(double length) const {
  std::vector<double> near;
  for (const double each : CloseTo(log_lengths_, std::log(length))) near.push_back(std::exp(each));
  return near;
}

}  // namespace orbweave
