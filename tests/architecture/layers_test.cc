// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/architecture/layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace orbweave::architecture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kExample[] =
    "# bottom first\n"
    "core/base\n"
    "core/left core/right\n"
    "top  # sees all\n"
    "fence metis.h core/left\n"
    "fence grpc top/grpc_\n";

TEST(ParseLayers, ReadsRowsAndFences) {
  const Layers layers = ParseLayers(kExample);
  EXPECT_EQ(layers.row_of_folder.at("core/base"), 0);
  EXPECT_EQ(layers.row_of_folder.at("core/left"), layers.row_of_folder.at("core/right"));
  EXPECT_GT(layers.row_of_folder.at("top"), layers.row_of_folder.at("core/right"));
  ASSERT_EQ(layers.fences.size(), 2U);
  EXPECT_EQ(layers.FolderOf("core/left/a.h"), "core/left");
  EXPECT_EQ(layers.FolderOf("core/leftover/a.h"), "");
}

TEST(FindIncludes, ReadsBothForms) {
  const auto includes = FindIncludes("#include <vector>\n// #include no\n  #  include \"a/b.h\"\n");
  ASSERT_EQ(includes.size(), 2U);
  EXPECT_EQ(includes[0].target, "vector");
  EXPECT_EQ(includes[1].line, 3);
  EXPECT_EQ(includes[1].target, "a/b.h");
}

TEST(CheckIncludes, AllowsTheSameFolderAndRowsBelow) {
  const Layers layers = ParseLayers(kExample);
  EXPECT_THAT(
      CheckIncludes(layers,
                    "core/left/a.cc",
                    "#include \"core/left/a.h\"\n#include \"core/base/b.h\"\n#include <metis.h>\n"),
      IsEmpty());
  EXPECT_THAT(CheckIncludes(layers, "top/grpc_service.cc", "#include <grpcpp/server.h>\n"),
              IsEmpty());
}

TEST(CheckIncludes, ReportsLooksUpAndSideways) {
  const Layers layers = ParseLayers(kExample);
  EXPECT_THAT(CheckIncludes(layers, "core/base/a.cc", "\n#include \"core/left/a.h\"\n"),
              ElementsAre("core/base/a.cc:2: core/base looks up to core/left"));
  EXPECT_THAT(CheckIncludes(layers, "core/left/a.cc", "#include \"core/right/a.h\"\n"),
              ElementsAre("core/left/a.cc:1: core/left looks sideways to core/right"));
}

TEST(CheckIncludes, ReportsWhoClimbsAFence) {
  const Layers layers = ParseLayers(kExample);
  EXPECT_THAT(CheckIncludes(layers, "core/right/a.cc", "#include <metis.h>\n"),
              ElementsAre("core/right/a.cc:1: metis.h is fenced off"));
  EXPECT_THAT(CheckIncludes(layers, "top/service.cc", "#include <grpcpp/server.h>\n"),
              ElementsAre("top/service.cc:1: grpcpp/server.h is fenced off"));
}

TEST(CheckIncludes, ReportsFoldersWithoutARow) {
  EXPECT_THAT(CheckIncludes(ParseLayers(kExample), "elsewhere/a.cc", ""),
              ElementsAre("elsewhere/a.cc:1: its folder is in no row of LAYERS"));
}

TEST(Repository, LooksDownOnly) {
  const Layers layers = ParseLayers(ReadRepositoryFile("LAYERS"));
  ASSERT_GT(layers.row_of_folder.size(), 10U);
  size_t num_files = 0;
  for (const SourceFile& file :
       ReadTree({"core", "proto", "security", "stages", "coordinator", "worker", "cli"})) {
    if (!IsCpp(file.path)) continue;
    ++num_files;
    for (const std::string& complaint : CheckIncludes(layers, file.path, file.text))
      ADD_FAILURE() << complaint;
  }
  EXPECT_GT(num_files, 50U);
}

TEST(Repository, KeepsMessagesAndCallsOutOfTheCore) {
  for (const SourceFile& file : ReadTree({"core"})) {
    if (!IsCpp(file.path)) continue;
    for (const Include& include : FindIncludes(file.text)) {
      const bool is_wire = include.target.ends_with(".pb.h") ||
                           include.target.starts_with("grpc") ||
                           include.target.starts_with("google/protobuf");
      EXPECT_FALSE(is_wire) << file.path << ":" << include.line << ": " << include.target;
    }
  }
}

}  // namespace
}  // namespace orbweave::architecture
