// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/text_fields.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(SplitFields, UnderstandsQuotes) {
  EXPECT_EQ(SplitFields("a, \"b,c\" ,\"d\"\"e\",", ','),
            (std::vector<std::string>{"a", "b,c", "d\"e", ""}));
}

TEST(CsvField, IsReadBackBySplitFields) {
  for (const std::string name :
       {"plain", "a,b", "say \"x\"", "a\tb", "=1+1", "'=1+1", "''@x", "-a,b", "'quoted'", "'"}) {
    EXPECT_EQ(SplitFields(CsvField(name) + ",1", ',').front(), name);
  }
}

TEST(CsvField, DefusesFormulas) {
  for (const std::string formula :
       {"=HYPERLINK(\"http://x\")", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1"}) {
    const std::string field = CsvField(formula);
    EXPECT_EQ(field.substr(field[0] == '"' ? 1 : 0, 2), "'" + formula.substr(0, 1));
  }
  EXPECT_EQ(CsvField("a=1.jpg"), "a=1.jpg");
  EXPECT_EQ(CsvField("'a'"), "'a'");
}

TEST(SplitLines, TakesAllLineEndsAndSkipsTheMark) {
  const auto lines = SplitLines("\xef\xbb\xbfone\r\ntwo\nthree\rfour");
  EXPECT_EQ(lines, (std::vector<std::string_view>{"one", "two", "three", "four"}));
}

TEST(NumberFromText, TakesTheWholeTextOrNothing) {
  EXPECT_EQ(NumberFromText(" +1.5e3 "), 1500.0);
  EXPECT_EQ(NumberFromText("-122.25"), -122.25);
  for (const char* text : {"", "1,5", "12 m", "abc", "1.5x"})
    EXPECT_FALSE(NumberFromText(text)) << text;
}

TEST(TimeFromText, ReadsExifAndIsoTimes) {
  EXPECT_EQ(TimeFromText("1970:01:02 00:00:01"), 86401.0);
  EXPECT_EQ(TimeFromText("2016:11:13 11:16:31"), 1479035791.0);
  EXPECT_EQ(TimeFromText("2016-11-13T11:16:31.5Z"), 1479035791.5);
  EXPECT_EQ(TimeFromText("2016-11-13T13:16:31+02:00"), 1479035791.0);
  EXPECT_EQ(TimeFromText("17.25"), 17.25);
}

TEST(TimeFromText, RefusesWhatIsNoTime) {
  for (const char* text : {"",
                           "    :  :     :  :  ",
                           "2016:13:13 11:16:31",
                           "2016:11:13",
                           "2016:11:13 11:16:31 soon"}) {
    EXPECT_FALSE(TimeFromText(text)) << text;
  }
}

}  // namespace
}  // namespace orbweave
