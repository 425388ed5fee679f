// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>

#include "core/io/gnss/reference_poses.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(reference_poses) {
  const auto poses = orbweave::ParseReferencePoses(orbweave::BytesOf(data, size), "table");
  if (!poses.ok()) return;
  for (const auto& [name, pose] : *poses) {
    ORBWEAVE_CHECK(std::abs(pose.rotation.norm() - 1.0) < 1e-9);
    ORBWEAVE_CHECK(pose.translation.allFinite());
  }
}
