// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/real_roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr double kNegligible = 1e-14;  // of the largest coefficient
constexpr double kBound = 1.0 - 1e-8;  // of |s|, see X
constexpr double kNarrow = 1e-13;      // roots closer than this in s count as one
constexpr double kConverged = 1e-14;   // step in s; Newton's next one would be far smaller
constexpr int kMaxPolishSteps = 60;

struct Polynomial {
  std::array<double, kMaxPolynomialDegree + 1> c{};
  int degree = -1;  // -1: zero

  [[nodiscard]] double At(double x) const {
    double value = c[degree];
    for (int k = degree - 1; k >= 0; --k) value = value * x + c[k];
    return value;
  }
  /// {p(x), p'(x)}
  [[nodiscard]] std::pair<double, double> WithSlopeAt(double x) const {
    double value = c[degree];
    double slope = 0.0;
    for (int k = degree - 1; k >= 0; --k) {
      slope = slope * x + value;
      value = value * x + c[k];
    }
    return {value, slope};
  }
};

/// Drops negligible leading coefficients and scales the largest to one; the sign stays.
Polynomial Normalised(Polynomial p, double negligible) {
  double largest = 0.0;
  for (int k = 0; k <= p.degree; ++k) largest = std::max(largest, std::abs(p.c[k]));
  while (p.degree >= 0 && std::abs(p.c[p.degree]) <= negligible * largest) --p.degree;
  for (int k = 0; k <= p.degree; ++k) p.c[k] /= largest;
  return p;
}

Polynomial Derivative(const Polynomial& p) {
  Polynomial d;
  d.degree = p.degree - 1;
  for (int k = 1; k <= p.degree; ++k) d.c[k - 1] = k * p.c[k];
  return d;
}

/// -(a mod b), not normalised; degree -1 when b divides a up to rounding.
Polynomial NegatedRemainder(Polynomial a, const Polynomial& b) {
  for (int k = a.degree; k >= b.degree; --k) {
    const double factor = a.c[k] / b.c[b.degree];
    for (int j = 0; j < b.degree; ++j) a.c[k - b.degree + j] -= factor * b.c[j];
  }
  a.degree = b.degree - 1;
  double largest = 0.0;
  for (int k = 0; k <= a.degree; ++k) {
    a.c[k] = -a.c[k];
    largest = std::max(largest, std::abs(a.c[k]));
  }
  if (largest < kNegligible) a.degree = -1;
  return a;
}

class SturmChain {
 public:
  explicit SturmChain(const Polynomial& p) {
    chain_[0] = p;
    chain_[1] = Normalised(Derivative(p), 0.0);
    size_ = 2;
    while (chain_[size_ - 1].degree > 0) {
      const Polynomial next = NegatedRemainder(chain_[size_ - 2], chain_[size_ - 1]);
      if (next.degree < 0) break;
      chain_[size_++] = Normalised(next, kNegligible);
    }
  }

  /// Changes of sign along the chain; their difference counts the roots in (a, b].
  [[nodiscard]] int SignChanges(double x) const {
    int changes = 0;
    bool was_negative = chain_[0].At(x) < 0.0;
    for (int i = 1; i < size_; ++i) {
      const double value = chain_[i].At(x);
      if (value == 0.0) continue;
      const bool is_negative = value < 0.0;
      changes += is_negative != was_negative ? 1 : 0;
      was_negative = is_negative;
    }
    return changes;
  }

 private:
  std::array<Polynomial, kMaxPolynomialDegree + 2> chain_{};
  int size_ = 0;
};

/// The whole line on (-1, 1): bisection of s finds roots of any magnitude equally fast.
double X(double s) { return s / (1.0 - std::abs(s)); }
double S(double x) { return x / (1.0 + std::abs(x)); }

/// The root between low and high (in s), where p changes its sign.
double Polish(const Polynomial& p, double low, double high) {
  const bool low_is_negative = p.At(X(low)) < 0.0;
  double s = 0.5 * (low + high);
  for (int step = 0; step < kMaxPolishSteps; ++step) {
    const double x = X(s);
    const auto [value, slope] = p.WithSlopeAt(x);
    if (value == 0.0) break;
    ((value < 0.0) == low_is_negative ? low : high) = s;
    const double newton = S(x - value / slope);
    const double previous = s;
    s = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(s - previous) < kConverged) break;
  }
  return X(s);
}

struct Interval {
  double low;
  double high;
  int changes_low;
  int changes_high;
};

}  // namespace

absl::InlinedVector<double, kMaxPolynomialDegree> RealRoots(std::span<const double> coefficients) {
  ORBWEAVE_CHECK(coefficients.size() <= kMaxPolynomialDegree + 1);
  absl::InlinedVector<double, kMaxPolynomialDegree> roots;
  Polynomial p;
  std::copy(coefficients.begin(), coefficients.end(), p.c.begin());
  p.degree = static_cast<int>(coefficients.size()) - 1;
  p = Normalised(p, kNegligible);
  if (p.degree < 1 || !std::isfinite(p.At(1.0))) return roots;

  const SturmChain chain(p);
  absl::InlinedVector<Interval, 64> open;
  open.push_back({-kBound, kBound, chain.SignChanges(X(-kBound)), chain.SignChanges(X(kBound))});
  while (!open.empty()) {
    const Interval i = open.back();
    open.pop_back();
    const int count = i.changes_low - i.changes_high;
    if (count <= 0) continue;
    const bool changes_sign = (p.At(X(i.low)) < 0.0) != (p.At(X(i.high)) < 0.0);
    if (count == 1 && changes_sign) {
      roots.push_back(Polish(p, i.low, i.high));
      continue;
    }
    const double middle = 0.5 * (i.low + i.high);
    if (i.high - i.low < kNarrow) {
      roots.push_back(X(middle));
      continue;
    }
    const int changes = chain.SignChanges(X(middle));
    open.push_back({middle, i.high, changes, i.changes_high});
    open.push_back({i.low, middle, i.changes_low, changes});
  }
  return roots;
}

}  // namespace orbweave
