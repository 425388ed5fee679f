// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/base/random.h"
#include "core/merging/alignment/find_common_view.h"
#include "core/merging/alignment/seam_evidence.h"
#include "tests/core/merging/split_world.h"

namespace orbweave::testing {

/// What two submodels of a straight street have to say of the seam between them, and how they lie.
struct SeamWorld {
  SeamEvidence evidence{};
  Sim3 a_from_b{};
};

/// Of `images` panoramas the first and the last six are in one submodel alone.
inline SeamWorld MakeSeam(uint32_t images, double noise_m, uint64_t seed) {
  Random random(seed);
  const auto world =
      Split(MakeStreet(StraightLine(images, 2.0), random), 2, 6, images - 6, noise_m, random);
  const Reconstruction& a = world.submodels[0].reconstruction;
  const Reconstruction& b = world.submodels[1].reconstruction;
  const auto index_a = IndexFeatures(a);
  const CommonView view = FindCommonView(a, index_a, b, IndexFeatures(b));
  return {GatherSeamEvidence(a, index_a, b, view),
          world.submodel_from_street[0] * world.submodel_from_street[1].Inverse()};
}

}  // namespace orbweave::testing
