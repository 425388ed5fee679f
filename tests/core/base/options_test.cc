// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/options.h"

#include <gtest/gtest.h>

namespace orbweave {

enum class Flavour { kSweet, kSour };

template <>
struct EnumNames<Flavour> {
  static constexpr std::array<std::pair<Flavour, std::string_view>, 2> kNames = {
      {{Flavour::kSweet, "sweet"}, {Flavour::kSour, "sour"}}};
};

namespace {

struct JamOptions {
  double sugar = 0.1;
  int jars = 3;
  bool lids = true;
  Flavour flavour = Flavour::kSour;
  std::string label = "plum";

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("sugar", self.sugar, "share of sugar", Range{0.0, 1.0});
    visit("jars", self.jars, "number of jars", Range{1, 100});
    visit("lids", self.lids, "close the jars");
    visit("flavour", self.flavour, "which plums");
    visit("label", self.label, "what it says on them");
  }
};

TEST(Options, HaveACanonicalText) {
  EXPECT_EQ(OptionsToText("jam", JamOptions{}),
            "jam.sugar=0.1\njam.jars=3\njam.lids=true\njam.flavour=sour\njam.label=plum\n");
}

TEST(Options, GoThroughTextAndBack) {
  const JamOptions original{
      .sugar = 1.0 / 3.0, .jars = 17, .lids = false, .flavour = Flavour::kSweet, .label = "a b"};
  JamOptions copy;
  for (const OptionInfo& info : DescribeOptions("jam", original)) {
    EXPECT_TRUE(SetOption(copy, info.name.substr(4), info.value).ok()) << info.name;
  }
  EXPECT_EQ(OptionsToText("jam", copy), OptionsToText("jam", original));
  EXPECT_EQ(copy.sugar, original.sugar) << "the text of a number is exact";
}

TEST(Options, DescribeRangesAndNames) {
  const auto infos = DescribeOptions("jam", JamOptions{});
  ASSERT_EQ(infos.size(), 5U);
  EXPECT_EQ(infos[0].range, "[0, 1]");
  EXPECT_EQ(infos[0].help, "share of sugar");
  EXPECT_EQ(infos[2].range, "true|false");
  EXPECT_EQ(infos[3].range, "sweet|sour");
}

TEST(Options, RefuseWhatDoesNotFitAndStayAsTheyWere) {
  JamOptions options;
  EXPECT_EQ(SetOption(options, "sugar", "1.5").code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(SetOption(options, "sugar", "much").code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(SetOption(options, "sugar", "nan").code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(SetOption(options, "jars", "2.5").code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(SetOption(options, "jars", "4294967299").code(), absl::StatusCode::kInvalidArgument)
      << "it would wrap to 3";
  EXPECT_EQ(SetOption(options, "jars", "0").code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(SetOption(options, "lids", "maybe").code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(SetOption(options, "flavour", "bitter").code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(SetOption(options, "spoons", "3").code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(OptionsToText("jam", options), OptionsToText("jam", JamOptions{}));
}

TEST(Options, SayWhichNamesAnEnumerationHas) {
  JamOptions options;
  EXPECT_NE(SetOption(options, "flavour", "bitter").message().find("sweet, sour"),
            absl::string_view::npos);
}

TEST(Options, ReadSeveralWordsForTrueAndFalse) {
  JamOptions options;
  for (const char* word : {"false", "0", "no", "off"}) {
    options.lids = true;
    EXPECT_TRUE(SetOption(options, "lids", word).ok());
    EXPECT_FALSE(options.lids) << word;
  }
  for (const char* word : {"true", "1", "yes", "on"}) {
    options.lids = false;
    EXPECT_TRUE(SetOption(options, "lids", word).ok());
    EXPECT_TRUE(options.lids) << word;
  }
}

TEST(Options, AreValidatedByName) {
  EXPECT_TRUE(ValidateOptions("jam", JamOptions{}).ok());
  const absl::Status status = ValidateOptions("jam", JamOptions{.jars = 1000});
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(status.message().find("jam.jars=1000"), absl::string_view::npos) << status;
  EXPECT_NE(status.message().find("[1, 100]"), absl::string_view::npos) << status;
}

TEST(NearestName, FindsTheMisspelt) {
  const std::vector<std::string> names = {"sugar", "jars", "lids"};
  EXPECT_EQ(NearestName("suger", names), "sugar");
  EXPECT_EQ(NearestName("jar", names), "jars");
  EXPECT_EQ(NearestName("lids", names), "lids");
  EXPECT_EQ(NearestName("x", {}), "");
}

}  // namespace
}  // namespace orbweave
