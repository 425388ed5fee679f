// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/identity.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(Identity, IsTheSameAfterItsUri) {
  for (const Role role : {Role::kCoordinator, Role::kWorker, Role::kClient, Role::kAdmin}) {
    const Identity identity{.fleet = "city-1", .role = role, .name = "node_7.example"};
    const auto back = Identity::FromUri(identity.ToUri());
    ASSERT_TRUE(back.ok()) << identity.ToUri();
    EXPECT_EQ(*back, identity);
  }
}

TEST(Identity, RefusesWhatIsNone) {
  for (const char* uri : {"",
                          "orbweave://",
                          "orbweave://city/worker",
                          "orbweave://city/worker/",
                          "orbweave://city//name",
                          "orbweave:///worker/name",
                          "orbweave://city/king/name",
                          "orbweave://city/worker/name/more",
                          "orbweave://city/worker/..",
                          "orbweave://city/worker/a b",
                          "https://city/worker/name",
                          "ORBWEAVE://city/worker/name"}) {
    EXPECT_TRUE(absl::IsInvalidArgument(Identity::FromUri(uri).status())) << uri;
  }
}

TEST(CheckName, TakesWhatIsSafeEverywhere) {
  EXPECT_TRUE(CheckName("a").ok());
  EXPECT_TRUE(CheckName("7th-node_of.example").ok());
  EXPECT_TRUE(CheckName(std::string(100, 'a')).ok());
  for (const std::string& name : {std::string(),
                                  std::string(101, 'a'),
                                  std::string("-a"),
                                  std::string("."),
                                  std::string("a/b"),
                                  std::string("a\nb"),
                                  std::string("a,URI:b"),
                                  std::string("a\0b", 3)}) {
    EXPECT_FALSE(CheckName(name).ok()) << name;
  }
}

TEST(MaySpeakFor, ItsOwnNameAndThoseBelowIt) {
  const Identity node{.fleet = "city", .role = Role::kWorker, .name = "node"};
  EXPECT_TRUE(MaySpeakFor(node, "node"));
  EXPECT_TRUE(MaySpeakFor(node, "node/host-17"));
  EXPECT_FALSE(MaySpeakFor(node, "node/"));
  EXPECT_FALSE(MaySpeakFor(node, "node/a\nworker joined worker=b")) << "names go to the log";
  EXPECT_FALSE(MaySpeakFor(node, "node2"));
  EXPECT_FALSE(MaySpeakFor(node, "other"));
  EXPECT_FALSE(MaySpeakFor(node, ""));
}

TEST(MaySpeakFor, AnAdminAnybodyAClientNobody) {
  EXPECT_TRUE(MaySpeakFor({.fleet = "city", .role = Role::kAdmin, .name = "boss"}, "node"));
  EXPECT_FALSE(MaySpeakFor({.fleet = "city", .role = Role::kClient, .name = "node"}, "node"));
}

}  // namespace
}  // namespace orbweave
