// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/separator_tree.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace orbweave {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

using UseCounts = std::map<SeparatorId, uint32_t>;

// Subproblems that are added together: nodes or subproblems below, and the separators that others
// use, too, with the number of its subproblems that use them.
struct Group {
  std::vector<uint32_t> children{};
  UseCounts uses{};
};

// Joined separators that no other group uses are done with.
Group Joined(Group a, const Group& b, const UseCounts& uses_in_all) {
  a.children.insert(a.children.end(), b.children.begin(), b.children.end());
  std::sort(a.children.begin(), a.children.end());
  for (const auto& [id, count] : b.uses) a.uses[id] += count;
  std::erase_if(a.uses, [&](const auto& use) { return use.second == uses_in_all.at(use.first); });
  return a;
}

// How many separators each pair of groups shares.
std::map<std::pair<uint32_t, uint32_t>, uint32_t> SharedCounts(const std::vector<Group>& groups) {
  std::map<SeparatorId, std::vector<uint32_t>> users;
  for (uint32_t g = 0; g < groups.size(); ++g) {
    for (const auto& [id, count] : groups[g].uses) users[id].push_back(g);
  }
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> shared;
  for (const auto& [id, list] : users) {
    for (size_t j = 1; j < list.size(); ++j) {
      for (size_t i = 0; i < j; ++i) ++shared[{list[i], list[j]}];
    }
  }
  return shared;
}

// partner[g], kNone for the odd one: heaviest pairs first, then who is left over, in order.
std::vector<uint32_t> MatchGroups(const std::vector<Group>& groups) {
  struct Edge {
    uint32_t weight = 0;
    uint32_t a = 0;
    uint32_t b = 0;
  };
  std::vector<Edge> edges;
  for (const auto& [pair, weight] : SharedCounts(groups)) {
    edges.push_back({weight, pair.first, pair.second});
  }
  std::stable_sort(
      edges.begin(), edges.end(), [](const Edge& x, const Edge& y) { return x.weight > y.weight; });
  std::vector<uint32_t> partner(groups.size(), kNone);
  const auto match = [&](uint32_t a, uint32_t b) {
    partner[a] = b;
    partner[b] = a;
  };
  for (const Edge& edge : edges) {
    if (partner[edge.a] == kNone && partner[edge.b] == kNone) match(edge.a, edge.b);
  }
  uint32_t waiting = kNone;
  for (uint32_t g = 0; g < groups.size(); ++g) {
    if (partner[g] != kNone) continue;
    if (waiting == kNone) {
      waiting = g;
    } else {
      match(waiting, g);
      waiting = kNone;
    }
  }
  return partner;
}

std::vector<Group> JoinPairs(const std::vector<Group>& groups, const UseCounts& uses_in_all) {
  const std::vector<uint32_t> partner = MatchGroups(groups);
  std::vector<Group> joined;
  for (uint32_t g = 0; g < groups.size(); ++g) {
    if (partner[g] == kNone) {
      joined.push_back(groups[g]);
    } else if (g < partner[g]) {
      joined.push_back(Joined(groups[g], groups[partner[g]], uses_in_all));
    }
  }
  return joined;
}

// A node for each group of several; the group is then that node.
void AddNodes(std::vector<Group>& groups, SeparatorTree& tree) {
  for (Group& group : groups) {
    if (group.children.size() == 1 && groups.size() > 1) continue;
    SeparatorNode& node = tree.nodes.emplace_back();
    node.children = std::exchange(
        group.children, {tree.num_subproblems + static_cast<uint32_t>(tree.nodes.size()) - 1});
    for (const auto& [id, count] : group.uses) node.retained.push_back(id);
  }
}

}  // namespace

SeparatorTree MakeSeparatorTree(
    const std::vector<std::vector<SeparatorId>>& separators_of_subproblem, int doublings) {
  SeparatorTree tree{.num_subproblems = static_cast<uint32_t>(separators_of_subproblem.size())};
  UseCounts uses_in_all;
  std::vector<Group> groups;
  for (uint32_t subproblem = 0; subproblem < tree.num_subproblems; ++subproblem) {
    Group& group = groups.emplace_back(Group{.children = {subproblem}});
    for (const SeparatorId& id : separators_of_subproblem[subproblem]) {
      group.uses[id] = 1;
      ++uses_in_all[id];
    }
  }
  do {
    for (int i = 0; groups.size() > 1 && (i < doublings || doublings == 0); ++i) {
      groups = JoinPairs(groups, uses_in_all);
    }
    AddNodes(groups, tree);
  } while (groups.size() > 1);
  return tree;
}

}  // namespace orbweave
