// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The law that the collection of garbage rests on: what a blob names stands in its bytes, so that
// whoever looks for 32 bytes of a digest finds it, whatever the format.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "core/io/images/image_sources.h"
#include "core/pipeline/job_plan.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/recipes_codec.h"
#include "proto/codec/subproblem_codec.h"

namespace orbweave {
namespace {

const Digest kOne = DigestOf("one");
const Digest kTwo = DigestOf("two");
const Digest kThree = DigestOf("three");
const Digest kFour = DigestOf("four");

std::string BytesOf(const absl::StatusOr<std::string>& encoded) { return encoded.value(); }

/// By message with a digest: a blob that has it, with `count` digests in all its fields.
struct Example {
  std::string bytes{};
  size_t count = 0;
};

std::map<std::string, Example> Examples() {
  const std::vector<FeatureFile> files = {{ImageId(0), kOne}, {ImageId(1), kTwo}};
  return {
      {"SourceImage",
       {BytesOf(EncodeImageSources({.images = {{.name = "a", .content = kOne, .mask = kTwo}}})),
        2}},
      {"ImageRecord",
       {BytesOf(EncodeImageManifest({.images = {{.name = "a", .content = kOne, .mask = kTwo}}})),
        2}},
      {"ExtractRecipe", {BytesOf(EncodeExtractRecipe({.image = kOne, .mask = kTwo})), 2}},
      {"FeatureFile", {BytesOf(EncodeMatchRecipe({.images = files})), 2}},
      {"ClusterRecipe",
       {BytesOf(EncodeClusterRecipe({.images = files, .matches = {kThree, kFour}})), 4}},
      {"AssembleRecipe", {BytesOf(EncodeAssembleRecipe({.cluster_result = kOne})), 1}},
      {"SubproblemTask", {BytesOf(EncodeSubproblemTask({.subproblem = kOne, .state = kTwo})), 2}},
      {"SubproblemResult",
       {BytesOf(EncodeSubproblemResult({.subproblem = kOne, .state = kTwo, .inspection = kThree})),
        3}},
      {"SubproblemPlace",
       {BytesOf(EncodeAdjustmentProgress(
            {.subproblems =
                 {{.subproblem = kOne, .state = kTwo, .trial = kThree, .inspection = kFour}}})),
        4}},
      {"FinalisedWorld",
       {BytesOf(EncodeFinalisedModel({.worlds = {{}}, .subproblems = {{kOne, kTwo}}})), 2}},
  };
}

bool Names(const std::string& bytes, const Digest& digest) {
  const std::string_view name(reinterpret_cast<const char*>(digest.bytes.data()),
                              digest.bytes.size());
  return bytes.find(name) != std::string::npos;
}

/// Messages with a field that is a digest, as the comments of the format say.
std::set<std::string> MessagesWithDigests(const std::string& proto) {
  std::ifstream file(std::string(ORBWEAVE_SOURCE_DIR) + "/proto/orbweave/v1/" + proto);
  std::set<std::string> messages;
  std::string message;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("message ")) message = line.substr(8, line.find(' ', 8) - 8);
    const bool is_field =
        line.find("bytes ") != std::string::npos && line.find(" = ") != std::string::npos;
    if (is_field && line.find("digest", line.find("//")) != std::string::npos)
      messages.insert(message);
  }
  return messages;
}

TEST(NamedDigests, StandInTheBytesOfEveryBlobThatNamesThem) {
  for (const auto& [message, example] : Examples()) {
    size_t found = 0;
    for (const Digest& digest : {kOne, kTwo, kThree, kFour}) found += Names(example.bytes, digest);
    EXPECT_EQ(found, example.count) << message;
  }
  const std::string collection = EncodeCollection({kOne, kTwo});
  EXPECT_TRUE(Names(collection, kOne) && Names(collection, kTwo));
}

TEST(NamedDigests, AreKnownOfEveryMessageOfTheFormat) {
  std::set<std::string> known;
  for (const auto& [message, example] : Examples()) known.insert(message);
  std::set<std::string> messages = MessagesWithDigests("artifacts.proto");
  messages.merge(MessagesWithDigests("adjustment.proto"));
  EXPECT_FALSE(messages.empty());
  EXPECT_EQ(messages, known) << "a message with a digest needs an example here";
}

}  // namespace
}  // namespace orbweave
