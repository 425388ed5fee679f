// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/false_alarms.h"

#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

double LogFactorial(size_t n) { return std::lgamma(static_cast<double>(n) + 1.0); }

double LogChoose(size_t n, size_t k) {
  return LogFactorial(n) - LogFactorial(k) - LogFactorial(n - k);
}

}  // namespace

double Log10FalseAlarms(size_t n, size_t k, size_t sample, double chance, size_t num_tests) {
  if (k <= sample) return 0.0;
  const double log_tests = std::log(static_cast<double>(num_tests * (n - sample))) +
                           LogChoose(n, k) + LogChoose(k, sample);
  const double log_chance = static_cast<double>(k - sample) * std::log(chance);
  return (log_tests + log_chance) / std::numbers::ln10;
}

double Log10PoissonTail(size_t count, double mean) {
  const auto first = static_cast<double>(count);
  if (first <= mean) return 0.0;
  const double log_first = first * std::log(mean) - mean - LogFactorial(count);
  double sum = 1.0;  // of the terms, as shares of the first
  double term = 1.0;
  for (double n = first + 1.0; term > 1e-12 * sum; n += 1.0) {
    term *= mean / n;
    sum += term;
  }
  return (log_first + std::log(sum)) / std::numbers::ln10;
}

}  // namespace orbweave
