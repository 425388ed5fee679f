// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/averaging/similarity_chart.h"
#include "core/base/random.h"
#include "tests/support/random_world.h"

namespace orbweave::testing {

/// Any rotation, scale between 1/3 and 3, translation within some tens of units.
inline Sim3 RandomSimilarity(Random& random) {
  return {
      std::exp(random.Uniform(-1.1, 1.1)), RandomRotation(random), RandomPoint(random, 0.0, 30.0)};
}

inline Vector7d RandomVector7(Random& random, double sigma) {
  Vector7d x;
  for (int i = 0; i < 7; ++i) x[i] = sigma * random.Normal();
  return x;
}

}  // namespace orbweave::testing
