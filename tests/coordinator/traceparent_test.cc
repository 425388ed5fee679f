// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traceparent.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

const std::string kTrace = "0af7651916cd43dd8448eb211c80319c";
const std::string kParent = "b7ad6b7169203331";

TEST(ParseTraceparent, ReadsTheExampleOfTheStandard) {
  const auto parsed = ParseTraceparent("00-" + kTrace + "-" + kParent + "-01");
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_EQ(parsed->trace_id, kTrace);
  EXPECT_EQ(parsed->parent_id, kParent);
  EXPECT_TRUE(parsed->is_sampled);
  EXPECT_FALSE(ParseTraceparent("00-" + kTrace + "-" + kParent + "-00")->is_sampled);
  EXPECT_FALSE(ParseTraceparent("00-" + kTrace + "-" + kParent + "-02")->is_sampled);
  EXPECT_TRUE(ParseTraceparent("00-" + kTrace + "-" + kParent + "-0b")->is_sampled);
}

TEST(ParseTraceparent, ReadsLaterVersionsAsFarAsTheyAreTheSame) {
  EXPECT_TRUE(ParseTraceparent("01-" + kTrace + "-" + kParent + "-01").ok());
  EXPECT_TRUE(ParseTraceparent("cc-" + kTrace + "-" + kParent + "-01-what-comes").ok());
  EXPECT_FALSE(ParseTraceparent("cc-" + kTrace + "-" + kParent + "-01.what").ok());
  EXPECT_FALSE(ParseTraceparent("00-" + kTrace + "-" + kParent + "-01-more").ok());
  EXPECT_FALSE(ParseTraceparent("ff-" + kTrace + "-" + kParent + "-01").ok());
}

TEST(ParseTraceparent, RefusesWhatIsNone) {
  const std::string zeros(32, '0');
  const std::vector<std::string> wrong = {"",
                                          "00",
                                          kTrace,
                                          "00-" + kTrace + "-" + kParent + "-1",
                                          "00-" + kTrace + "-" + kParent + "-0g",
                                          "00-" + zeros + "-" + kParent + "-01",
                                          "00-" + kTrace + "-" + zeros.substr(16) + "-01",
                                          "00-" + kTrace + "_" + kParent + "-01",
                                          "0A-" + kTrace + "-" + kParent + "-01",
                                          std::string(55, '-'),
                                          std::string(100'000, 'a')};
  for (const std::string& text : wrong) {
    const auto parsed = ParseTraceparent(text);
    EXPECT_EQ(parsed.status().code(), absl::StatusCode::kInvalidArgument) << text;
    EXPECT_LT(parsed.status().message().size(), 1000U);
  }
}

}  // namespace
}  // namespace orbweave
