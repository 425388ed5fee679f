// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/separator_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/synthetic/street.h"

namespace orbweave {
namespace {

// A street of subproblems: neighbours share three poses, all share a bias.
std::vector<std::vector<SeparatorId>> Street(uint32_t num_subproblems) {
  std::vector<std::vector<SeparatorId>> separators(num_subproblems);
  for (uint32_t subproblem = 0; subproblem < num_subproblems; ++subproblem) {
    for (uint32_t i = 0; i < 3; ++i) {
      if (subproblem > 0) {
        separators[subproblem].push_back({SeparatorId::Kind::kPose, 10 * (subproblem - 1) + i});
      }
      if (subproblem + 1 < num_subproblems) {
        separators[subproblem].push_back({SeparatorId::Kind::kPose, 10 * subproblem + i});
      }
    }
    separators[subproblem].push_back({SeparatorId::Kind::kBias, 0});
    std::sort(separators[subproblem].begin(), separators[subproblem].end());
  }
  return separators;
}

TEST(SeparatorTree, HasEverySubproblemOnceAndARootThatKeepsNothing) {
  for (const uint32_t num_subproblems : {2U, 3U, 13U, 64U}) {
    for (const int doublings : {0, 1, 3}) {
      const SeparatorTree tree = MakeSeparatorTree(Street(num_subproblems), doublings);
      std::multiset<uint32_t> children;
      for (uint32_t n = 0; n < tree.nodes.size(); ++n) {
        for (const uint32_t child : tree.nodes[n].children) {
          EXPECT_LT(child, num_subproblems + n);
          children.insert(child);
        }
      }
      std::multiset<uint32_t> all;
      for (uint32_t i = 0; i + 1 < num_subproblems + tree.nodes.size(); ++i) all.insert(i);
      EXPECT_EQ(children, all);
      EXPECT_TRUE(tree.nodes.back().retained.empty());
    }
  }
}

TEST(SeparatorTree, KeepsTheTwoEndsOfAStreet) {
  for (const uint32_t num_subproblems : {16U, 100U}) {
    const SeparatorTree tree = MakeSeparatorTree(Street(num_subproblems), 3);
    for (const SeparatorNode& node : tree.nodes) {
      EXPECT_LE(node.retained.size(), 2U * 3U + 1U);
      EXPECT_LE(node.children.size(), 8U);
    }
  }
}

TEST(SeparatorTree, IsOneRootWithoutDoublings) {
  const SeparatorTree tree = MakeSeparatorTree(Street(9), 0);
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_EQ(tree.nodes[0].children.size(), 9U);
}

TEST(SeparatorTree, JoinsSubproblemsThatShareNothing) {
  const SeparatorTree tree = MakeSeparatorTree({{}, {}, {}}, 1);
  EXPECT_TRUE(tree.nodes.back().retained.empty());
  EXPECT_EQ(tree.nodes.size(), 2U);
}

TEST(SeparatorTree, HasARootOverASingleSubproblem) {
  const SeparatorTree tree = MakeSeparatorTree({{}}, 3);
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_EQ(tree.nodes[0].children, std::vector<uint32_t>{0});
}

}  // namespace
}  // namespace orbweave
