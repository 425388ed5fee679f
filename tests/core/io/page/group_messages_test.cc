// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/group_messages.h"

#include <gmock/gmock.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;

TEST(CountedLines, MakeOneOfMessagesThatDifferInNumbersAndFileNames) {
  EXPECT_THAT(CountedLines(std::vector<std::string>{
                  "gnss.csv line 17 (IMG_0016.jpg) is not used: its position is 0/0",
                  "2 rows have no image: a1.jpg, a2.jpg",
                  "gnss.csv line 3 (left/street.jpg) is not used: its position is 0/0",
                  "5 rows have no image: b.jpg, c/d.png, x9, y.jpg, z.jpg",
                  "the masks are all white"}),
              ElementsAre("gnss.csv line 17 (IMG_0016.jpg) is not used: its position is 0/0 (and 1 "
                          "more of this kind)",
                          "2 rows have no image: a1.jpg, a2.jpg (and 1 more of this kind)",
                          "the masks are all white"));
}

TEST(CountedLines, KeepMessagesOfOtherWordsApart) {
  const std::vector<std::string> messages = {"3 of 4 fit", "3 of 4 break", "3 of them fit", ""};
  EXPECT_EQ(CountedLines(messages), messages);
  EXPECT_TRUE(CountedLines(std::vector<std::string>{}).empty());
}

TEST(CountedLines, NameTheFirstImageOfAReason) {
  EXPECT_THAT(CountedLines(std::vector<Exclusion>{{"a.jpg", "no pair could start"},
                                                  {"b.jpg", "truncated"},
                                                  {"c.jpg", "no pair could start"},
                                                  {"d.jpg", "3 of 20 points agree"},
                                                  {"e.jpg", "7 of 20 points agree"}}),
              ElementsAre("2 images: no pair could start, first a.jpg",
                          "b.jpg: truncated",
                          "2 images, such as d.jpg: 3 of 20 points agree"));
}

TEST(CommonestLine, IsThatOfTheLargestGroup) {
  EXPECT_EQ(CommonestLine(std::vector<Exclusion>{
                {"b.jpg", "truncated"}, {"a.jpg", "no pair"}, {"c.jpg", "no pair"}}),
            "2 images: no pair, first a.jpg");
  EXPECT_EQ(CommonestLine(std::vector<Exclusion>{}), "");
}

TEST(GroupByKind, LosesNobody) {
  const std::vector<std::string> messages = {"x 1", "y 1", "x 2", "x 1", "y 1"};
  size_t members = 0;
  for (const MessageGroup& group : GroupByKind(messages)) {
    members += group.members.size();
    for (const size_t member : group.members)
      EXPECT_EQ(messages[member].front(), messages[group.members.front()].front());
  }
  EXPECT_EQ(members, messages.size());
  EXPECT_FALSE(GroupByKind(messages)[0].same_words);
  EXPECT_TRUE(GroupByKind(messages)[1].same_words);
}

}  // namespace
}  // namespace orbweave
