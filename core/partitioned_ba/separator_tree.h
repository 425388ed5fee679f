// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/partitioned_ba/bundle_subproblem.h"

namespace orbweave {

/// Adds the systems of its children and eliminates what nobody outside uses.
struct SeparatorNode {
  std::vector<uint32_t>
      children{};  ///< below num_subproblems: a subproblem; else num_subproblems + node
  std::vector<SeparatorId> retained{};  ///< ascending; empty at the root
};

/// The order in which subproblems are added: fixed by who shares separators with whom, so that sums
/// have the same bits whoever forms them.
struct SeparatorTree {
  uint32_t num_subproblems = 0;
  std::vector<SeparatorNode> nodes{};  ///< children before parents, the root last
};

/// Eight children a node.
inline constexpr int kTreeDoublings = 3;

/// Nested elimination: from the subproblems upwards, groups that share the most separators are
/// joined (heavy-edge matching), `doublings` times per level (2^doublings children at most), until
/// one is left. On a street a group keeps the separators at its two ends, whatever its length.
/// `doublings` = 0: a root over all subproblems.
///
/// Four subproblems A to D of a street, doublings = 1; ab are the separators that A and B share. In
/// braces the variables of the system that goes up; their step comes down the same way:
///
///     A ---ab--- B ---bc--- C ---cd--- D
///
///                   2 {}                       the root
///                 /      \                     eliminates bc
///            0 {bc}      1 {bc}                nodes 0 and 1
///            /    \      /    \                eliminate ab and cd
///       A {ab} B {ab,bc} C {bc,cd} D {cd}      each eliminates its points and inner poses
[[nodiscard]] SeparatorTree MakeSeparatorTree(
    const std::vector<std::vector<SeparatorId>>& separators_of_subproblem,
    int doublings = kTreeDoublings);

}  // namespace orbweave
