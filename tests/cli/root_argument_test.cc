// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/root_argument.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

struct Parsed {
  std::map<std::string, std::string> roots{};
  std::string folder{};
};

Parsed Parse(const std::string& line) {
  Parsed parsed;
  CLI::App app;
  AddRootArgument(app, parsed.roots, "help");
  app.add_option("FOLDER", parsed.folder);
  app.parse(line);
  return parsed;
}

TEST(RootArgument, IsRepeatableAndLeavesWhatFollows) {
  const Parsed parsed = Parse("--root data=/a/b/../c --root more=/d images");
  EXPECT_THAT(parsed.roots, ElementsAre(Pair("data", "/a/c"), Pair("more", "/d")));
  EXPECT_EQ(parsed.folder, "images");
}

TEST(RootArgument, LeavesTheAddressOfAnObjectStoreAsItIs) {
  const std::string address = "s3://city/2026//a?endpoint=http://127.0.0.1:1&region=r";
  EXPECT_THAT(Parse("--root city=" + address).roots, ElementsAre(Pair("city", address)));
}

TEST(RootArgument, RefusesWhatIsNoRoot) {
  for (const char* line : {"--root data", "--root =/a", "--root a/b=/c", "--root ../x=/c"})
    EXPECT_THROW(Parse(line), CLI::ValidationError) << line;
}

}  // namespace
}  // namespace orbweave
