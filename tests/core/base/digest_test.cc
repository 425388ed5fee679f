// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/digest.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace orbweave {
namespace {

// FIPS 180-4 examples.
constexpr char kEmptyHex[] = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr char kAbcHex[] = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(Digest, IsSha256) {
  EXPECT_EQ(DigestOf("").ToHex(), kEmptyHex);
  EXPECT_EQ(DigestOf("abc").ToHex(), kAbcHex);
  EXPECT_EQ(DigestOf(std::string(1000000, 'a')).ToHex(),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, GoesThroughHexAndBack) {
  const Digest digest = DigestOf("orbweave");
  const auto back = Digest::FromHex(digest.ToHex());
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(*back, digest);
  EXPECT_EQ(digest.ToShortHex(), digest.ToHex().substr(0, 12));
}

TEST(Digest, RefusesWhatIsNotHex) {
  const std::string hex = kAbcHex;
  for (const std::string& text :
       {std::string(), hex.substr(1), hex + "0", "g" + hex.substr(1), "-" + hex.substr(1)}) {
    EXPECT_EQ(Digest::FromHex(text).status().code(), absl::StatusCode::kInvalidArgument) << text;
  }
}

TEST(Digest, IsZeroOnlyByDefault) {
  EXPECT_TRUE(Digest{}.IsZero());
  EXPECT_FALSE(DigestOf("").IsZero());
}

TEST(Digest, SeedsDifferWithContent) { EXPECT_NE(DigestOf("a").ToSeed(), DigestOf("b").ToSeed()); }

TEST(DigestBuilder, JoinsPieces) {
  EXPECT_EQ(DigestBuilder().Add("a").Add("").Add("bc").Finish().ToHex(), kAbcHex);
}

TEST(DigestBuilder, KeepsFieldsApart) {
  EXPECT_NE(DigestBuilder().AddField("ab").AddField("c").Finish(),
            DigestBuilder().AddField("a").AddField("bc").Finish());
}

TEST(DigestOfFile, ReadsAllBytes) {
  const std::string path = std::filesystem::path(::testing::TempDir()) / "digest_test.bin";
  const std::string content(300000, 'x');
  std::ofstream(path, std::ios::binary) << content;
  const auto digest = DigestOfFile(path);
  std::remove(path.c_str());
  ASSERT_TRUE(digest.ok()) << digest.status();
  EXPECT_EQ(*digest, DigestOf(content));
}

TEST(DigestOfFile, NamesTheMissingFile) {
  const auto digest = DigestOfFile("no/such/file");
  EXPECT_EQ(digest.status().code(), absl::StatusCode::kNotFound);
  EXPECT_NE(digest.status().message().find("no/such/file"), absl::string_view::npos);
}

}  // namespace
}  // namespace orbweave
