// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/separator_system.h"

#include <algorithm>

#include "core/base/status.h"
#include "core/bundle/block_elimination.h"

namespace orbweave {
namespace {

// Where each of `variables` is in `all`, both ascending.
std::vector<uint32_t> Positions(const std::vector<SeparatorId>& variables,
                                const std::vector<SeparatorId>& all) {
  std::vector<uint32_t> positions;
  for (const SeparatorId& id : variables) {
    const auto it = std::lower_bound(all.begin(), all.end(), id);
    ORBWEAVE_CHECK(it != all.end() && *it == id);
    positions.push_back(static_cast<uint32_t>(it - all.begin()));
  }
  return positions;
}

std::vector<SeparatorId> Union(std::span<const SeparatorSystem> systems) {
  std::vector<SeparatorId> all;
  for (const SeparatorSystem& system : systems) {
    all.insert(all.end(), system.variables.begin(), system.variables.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Calls visit(index of a value, its place in the union's matrix). Ascending variables stay
// ascending, so that the upper triangle maps into the upper triangle.
template <typename Visit>
void ForEachBlock(const SymmetricBlockMatrix& S,
                  const std::vector<uint32_t>& positions,
                  const Visit& visit) {
  for (uint32_t j = 0; j < S.num_blocks; ++j) {
    for (uint32_t p = S.column_start[j]; p < S.column_start[j + 1]; ++p) {
      visit(p, BlockIndex{.column = positions[j], .row = positions[S.rows[p]]});
    }
  }
}

void Add(const SeparatorSystem& term, SeparatorSystem& sum) {
  const std::vector<uint32_t> positions = Positions(term.variables, sum.variables);
  ForEachBlock(term.normal.S, positions, [&](uint32_t p, BlockIndex index) {
    sum.normal.S.values[sum.normal.S.Find(index)] += term.normal.S.values[p];
  });
  for (size_t i = 0; i < positions.size(); ++i) {
    sum.normal.rhs[positions[i]] += term.normal.rhs[i];
    sum.normal.gradient[positions[i]] += term.normal.gradient[i];
    sum.normal.trace[positions[i]] += term.normal.trace[i];
  }
}

BlockElimination MakeElimination(const SeparatorSystem& sum,
                                 const std::vector<SeparatorId>& retained) {
  std::vector<uint8_t> is_retained(sum.variables.size(), 0);
  for (const uint32_t position : Positions(retained, sum.variables)) is_retained[position] = 1;
  return BlockElimination(sum.normal.S, std::move(is_retained));
}

}  // namespace

SeparatorSystem AddSystems(std::span<const SeparatorSystem> systems) {
  SeparatorSystem sum;
  sum.is_definite = std::all_of(systems.begin(), systems.end(), [](const SeparatorSystem& system) {
    return system.is_definite;
  });
  if (!sum.is_definite) return sum;
  sum.variables = Union(systems);
  std::vector<BlockIndex> pattern;
  for (const SeparatorSystem& system : systems) {
    ForEachBlock(system.normal.S,
                 Positions(system.variables, sum.variables),
                 [&](uint32_t, BlockIndex index) { pattern.push_back(index); });
  }
  sum.normal = MakeNormalSystem(
      MakeBlockMatrix(static_cast<uint32_t>(sum.variables.size()), std::move(pattern)));
  for (const SeparatorSystem& system : systems) Add(system, sum);
  return sum;
}

SeparatorSystem EliminateSeparators(const SeparatorSystem& sum,
                                    const std::vector<SeparatorId>& retained,
                                    double lambda) {
  SeparatorSystem remaining{.is_definite = false};
  if (!sum.is_definite) return remaining;
  BlockElimination elimination = MakeElimination(sum, retained);
  NormalSystem damped = sum.normal;
  if (!elimination.Eliminate(lambda, damped)) return remaining;
  remaining.variables = retained;
  remaining.normal = elimination.Remaining(damped);
  remaining.is_definite = true;
  return remaining;
}

std::optional<SeparatorStep> SolveSeparators(const SeparatorSystem& sum,
                                             const SeparatorStep& retained,
                                             double lambda) {
  if (!sum.is_definite) return std::nullopt;
  BlockElimination elimination = MakeElimination(sum, retained.variables);
  NormalSystem damped = sum.normal;
  if (!elimination.Eliminate(lambda, damped)) return std::nullopt;
  SeparatorStep step{.variables = sum.variables,
                     .steps = elimination.BackSubstitute(retained.steps)};
  step.predicted_decrease = elimination.PredictedDecrease(damped, step.steps);
  return step;
}

SeparatorStep Restricted(const SeparatorStep& step, const std::vector<SeparatorId>& variables) {
  SeparatorStep restricted{.variables = variables};
  for (const uint32_t position : Positions(variables, step.variables)) {
    restricted.steps.push_back(step.steps[position]);
  }
  return restricted;
}

size_t PayloadBytes(const SeparatorSystem& system) {
  constexpr size_t kPerVariable =
      sizeof(SeparatorId) + 2 * sizeof(Vector6) + sizeof(Eigen::Vector2d);  // rhs, gradient; trace
  return system.variables.size() * kPerVariable +
         system.normal.S.values.size() * (sizeof(Block6) + sizeof(uint32_t));
}

}  // namespace orbweave
