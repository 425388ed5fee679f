// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/printable_text.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(PrintableText, LeavesWhatPeopleWrite) {
  for (const char* text : {"", "a b.jpg", "Straße 東京 🚋", "é"})
    EXPECT_EQ(PrintableText(text), text);
}

TEST(PrintableText, ReplacesAllThatATerminalObeys) {
  const std::string bad(kReplacementCharacter);
  for (int c = 0; c < 0x20; ++c)
    EXPECT_EQ(PrintableText(std::string(1, static_cast<char>(c)) + "x"), bad + "x") << c;
  EXPECT_EQ(PrintableText("\x7f"), bad);
  EXPECT_EQ(PrintableText("\x1b[2J"), bad + "[2J");
  EXPECT_EQ(PrintableText("\xc2\x9b"
                          "2J"),
            bad + "2J")
      << "the same in one character";
  EXPECT_EQ(PrintableText("\xe2\x80\xae"
                          "gpj"),
            bad + "gpj")
      << "written from right to left";
  EXPECT_EQ(PrintableText("\xe2\x81\xa6"
                          "a"),
            bad + "a");
  EXPECT_EQ(PrintableText("\xe2\x80\xa8"
                          "a"),
            bad + "a")
      << "a line separator";
}

TEST(PrintableText, ReplacesBytesThatAreNoUtf8OneByOne) {
  const std::string bad(kReplacementCharacter);
  EXPECT_EQ(PrintableText("\xff\xfe.jpg"), bad + bad + ".jpg");
  EXPECT_EQ(PrintableText("\xe2\x80"), bad + bad) << "cut off";
}

TEST(Utf8Text, ReplacesNothingElse) {
  EXPECT_EQ(Utf8Text("a\n\x1b é\xff"), "a\n\x1b é" + std::string(kReplacementCharacter));
}

TEST(PrintableText, KeepsWhatItIsTold) { EXPECT_EQ(PrintableText("a\nb", "\n"), "a\nb"); }

}  // namespace
}  // namespace orbweave
