// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "absl/container/inlined_vector.h"

namespace orbweave {

constexpr int kMaxPolynomialDegree = 10;

/// The different real roots of c[0] + c[1] x + ... + c[n] x^n, n <= 10, ascending, by Sturm's
/// theorem (isolation) and Newton's method kept inside a bracket (polish). Roots beyond +-1e8 are
/// left out; the zero polynomial and constants have none. A root of even multiplicity may be missed
/// once rounding has lifted the polynomial off the axis.
[[nodiscard]] absl::InlinedVector<double, kMaxPolynomialDegree> RealRoots(
    std::span<const double> coefficients);

}  // namespace orbweave
