// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/cluster_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

const std::vector<std::string> kImages = {"a/1.jpg", "a/2.jpg", "b/3.jpg"};

std::string ErrorOf(std::string_view text) {
  const auto clusters = ReadClusterTable(text, "clusters.csv", kImages);
  EXPECT_EQ(clusters.status().code(), absl::StatusCode::kInvalidArgument);
  return std::string(clusters.status().message());
}

TEST(ReadClusterTable, GivesEveryImageItsCluster) {
  const auto clusters = ReadClusterTable(
      "Cluster,remark,Name\nnorth,x,a/1.jpg\n\nnorth,,2.jpg\n\"south, east\",,b/3\r\n",
      "clusters.csv",
      kImages);
  ASSERT_TRUE(clusters.ok()) << clusters.status();
  EXPECT_THAT(
      *clusters,
      ElementsAre(
          Pair("a/1.jpg", "north"), Pair("a/2.jpg", "north"), Pair("b/3.jpg", "south, east")));
}

TEST(ReadClusterTable, NamesUnknownAndMissingImages) {
  EXPECT_THAT(ErrorOf("name,cluster\n1.jpg,x\n2.jpg,x\n3.jpg,x\n9.jpg,y\n"),
              HasSubstr("1 row of clusters.csv names no image: 9.jpg"));
  EXPECT_THAT(ErrorOf("name,cluster\n1.jpg,x\n"),
              HasSubstr("2 images have no row in clusters.csv: a/2.jpg, b/3.jpg"));
}

TEST(ReadClusterTable, RefusesRowsItCannotUse) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("columns name and cluster"));
  EXPECT_THAT(ErrorOf("1.jpg,x\n"), HasSubstr("columns name and cluster"));
  EXPECT_THAT(ErrorOf("name,cluster\n1.jpg\n"), HasSubstr("line 2"));
  EXPECT_THAT(ErrorOf("name,cluster\n1.jpg,\n"), HasSubstr("line 2"));
  EXPECT_THAT(ErrorOf("name,cluster\n1.jpg,x\n1.jpg,y\n"), HasSubstr("1.jpg is named again"));
}

}  // namespace
}  // namespace orbweave
