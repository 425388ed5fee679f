// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/progress/progress_bar.h"

#include <gtest/gtest.h>

#include "tests/support/two_stages.h"

namespace orbweave {
namespace {

using testing::TwoStages;

TEST(FormatDuration, ReadsLikeAClock) {
  EXPECT_EQ(FormatDuration(0.2), "0 s");
  EXPECT_EQ(FormatDuration(59.4), "59 s");
  EXPECT_EQ(FormatDuration(65.0), "1 min 05 s");
  EXPECT_EQ(FormatDuration(7805.0), "2 h 10 min");
}

TEST(ProgressBar, WritesPlainLinesWhereNobodyLooks) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    ProgressBar bar(file);
    for (int i = 0; i < 10; ++i) bar.Update(TwoStages());
  }
  std::rewind(file);
  std::string text(1000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  EXPECT_EQ(text, " 75 %  second 5/10  0.5 tasks/s  about 10 s left  after 30 s\n");
}

}  // namespace
}  // namespace orbweave
