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

/// The interval of agreeing values that holds most of them.
struct Crowd {
  double middle = 0.0;
  ptrdiff_t size = 0;
};

/// The first of several that hold as many.
Crowd DensestOf(std::span<const double> sorted) {
  Crowd most;
  auto last = sorted.begin();
  for (auto first = sorted.begin(); first != sorted.end(); ++first) {
    while (last != sorted.end() && *last <= *first + 2.0 * kCloseTolerance) ++last;
    if (last - first > most.size) most = {0.5 * (*first + *(last - 1)), last - first};
  }
  return most;
}

}  // namespace

ToldLengths::ToldLengths(const Eigen::Vector3d& direction, std::vector<double> log_lengths)
    : direction_(direction), log_lengths_(std::move(log_lengths)) {
  std::ranges::sort(log_lengths_);
  lengths_.reserve(log_lengths_.size());
  for (const double each : log_lengths_) lengths_.push_back(std::exp(each));
}

double ToldLengths::CountAgreeing(const Eigen::Vector3d& step) const {
  const double length = step.norm();
  if (!(length > 0.0) || step.dot(direction_) < kMinCosDirection * length) return 0.0;
  return WeightOfRay() * static_cast<double>(CloseTo(log_lengths_, std::log(length)).size());
}

double ToldLengths::WeightOfRay() const {
  return std::min(1.0, kMaxRays / static_cast<double>(log_lengths_.size()));
}

double ToldLengths::MostWithin(double shortest, double longest) const {
  const auto first = std::ranges::lower_bound(log_lengths_, std::log(shortest) - kCloseTolerance);
  const auto last = std::ranges::upper_bound(log_lengths_, std::log(longest) + kCloseTolerance);
  return first < last ? WeightOfRay() * static_cast<double>(DensestOf({first, last}).size) : 0.0;
}

std::vector<double> ToldLengths::Modes() const {
  std::vector<double> left = log_lengths_;
  std::vector<double> modes;
  while (modes.size() < kModes && !left.empty()) {
    const double mode = DensestOf(left).middle;
    modes.push_back(std::exp(mode));
    std::erase_if(left, [mode](double each) { return std::abs(each - mode) <= kCloseTolerance; });
  }
  return modes;
}

std::optional<double> ToldLengths::ModeWithin(double shortest, double longest) const {
  const auto first = std::ranges::lower_bound(log_lengths_, std::log(shortest));
  const auto last = std::ranges::upper_bound(log_lengths_, std::log(longest));
  if (first >= last) return std::nullopt;
  return std::exp(DensestOf({first, last}).middle);
}

std::span<const double> ToldLengths::Near(double length) const {
  const std::span<const double> near = CloseTo(log_lengths_, std::log(length));
  return std::span(lengths_).subspan(static_cast<size_t>(near.data() - log_lengths_.data()),
                                     near.size());
}

}  // namespace orbweave
