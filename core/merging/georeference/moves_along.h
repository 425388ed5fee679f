// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace orbweave {

/// Where a carrier goes at a place: from the place before to the place after, which halves what a
/// tremble adds.
struct MoveAlong {
  size_t first = 0;
  size_t last = 0;
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();  ///< zero where it does not move
};

/// Of places one after the other. A carrier that went less than 0.3 of its usual step (UsualStep)
/// between neighbours stands. A step of more than three times either beside it is a gap, behind
/// which it was taken up elsewhere, and tells nothing of where it goes, if the others mostly lead
/// on where they follow each other: those of a camera that is carried from stand to stand do not.
[[nodiscard]] std::vector<MoveAlong> MovesAlong(std::span<const Eigen::Vector3d> places);

}  // namespace orbweave
