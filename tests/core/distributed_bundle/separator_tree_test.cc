// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/distributed_bundle/separator_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace orbweave {
namespace {

// A street of blocks: neighbours share three poses, all share a bias.
std::vector<std::vector<SeparatorId>> Street(uint32_t num_blocks) {
  std::vector<std::vector<SeparatorId>> separators(num_blocks);
  for (uint32_t block = 0; block < num_blocks; ++block) {
    for (uint32_t i = 0; i < 3; ++i) {
      if (block > 0) {
        separators[block].push_back({SeparatorId::Kind::kPose, 10 * (block - 1) + i});
      }
      if (block + 1 < num_blocks) {
        separators[block].push_back({SeparatorId::Kind::kPose, 10 * block + i});
      }
    }
    separators[block].push_back({SeparatorId::Kind::kBias, 0});
    std::sort(separators[block].begin(), separators[block].end());
  }
  return separators;
}

TEST(SeparatorTree, HasEveryBlockOnceAndARootThatKeepsNothing) {
  for (const uint32_t num_blocks : {2U, 3U, 13U, 64U}) {
    for (const int doublings : {0, 1, 3}) {
      const SeparatorTree tree = MakeSeparatorTree(Street(num_blocks), doublings);
      std::multiset<uint32_t> children;
      for (uint32_t n = 0; n < tree.nodes.size(); ++n) {
        for (const uint32_t child : tree.nodes[n].children) {
          EXPECT_LT(child, num_blocks + n);
          children.insert(child);
        }
      }
      std::multiset<uint32_t> all;
      for (uint32_t i = 0; i + 1 < num_blocks + tree.nodes.size(); ++i) all.insert(i);
      EXPECT_EQ(children, all);
      EXPECT_TRUE(tree.nodes.back().keep.empty());
    }
  }
}

TEST(SeparatorTree, KeepsTheTwoEndsOfAStreet) {
  for (const uint32_t num_blocks : {16U, 100U}) {
    const SeparatorTree tree = MakeSeparatorTree(Street(num_blocks), 3);
    for (const SeparatorNode& node : tree.nodes) {
      EXPECT_LE(node.keep.size(), 2U * 3U + 1U);
      EXPECT_LE(node.children.size(), 8U);
    }
  }
}

TEST(SeparatorTree, IsOneRootWithoutDoublings) {
  const SeparatorTree tree = MakeSeparatorTree(Street(9), 0);
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_EQ(tree.nodes[0].children.size(), 9U);
}

TEST(SeparatorTree, JoinsBlocksThatShareNothing) {
  const SeparatorTree tree = MakeSeparatorTree({{}, {}, {}}, 1);
  EXPECT_TRUE(tree.nodes.back().keep.empty());
  EXPECT_EQ(tree.nodes.size(), 2U);
}

TEST(SeparatorTree, HasARootOverASingleBlock) {
  const SeparatorTree tree = MakeSeparatorTree({{}}, 3);
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_EQ(tree.nodes[0].children, std::vector<uint32_t>{0});
}

}  // namespace
}  // namespace orbweave
