// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/progress/preparation_bar.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace orbweave {
namespace {

TEST(FormatPreparation, SaysHowFarAndHowLongStill) {
  EXPECT_EQ(FormatPreparation({10, 30, "images"}, 0, 5.0), "images 10/30  2/s  about 10 s left");
  EXPECT_EQ(FormatPreparation({30, 30, "images"}, 0, 60.0), "images 30/30  0.5/s");
  EXPECT_EQ(FormatPreparation({100, 6100, "files"}, 0, 10.0),
            "files 100/6100  10/s  about 10 min 00 s left");
}

TEST(FormatPreparation, SaysNoTimeWhereNoneCanBeKnown) {
  EXPECT_EQ(FormatPreparation({4000, 0, "objects"}, 0, 2.0), "objects 4000  2000/s");
  EXPECT_EQ(FormatPreparation({0, 30, "images"}, 0, 5.0), "images 0/30");
  EXPECT_EQ(FormatPreparation({10, 30, "images"}, 0, 0.1), "images 10/30");
}

TEST(FormatPreparation, CountsWhatWasDoneSinceTheCountingBegan) {
  EXPECT_EQ(FormatPreparation({5010, 5030, "files, some sent"}, 5000, 5.0),
            "files, some sent 5010/5030  2/s  about 10 s left");
  EXPECT_EQ(FormatPreparation({5000, 5030, "files, some sent"}, 5000, 5.0),
            "files, some sent 5000/5030");
}

TEST(PreparationBar, IsSilentInAFileAboutWhatIsShort) {
  std::FILE* const file = ::tmpfile();
  {
    PreparationBar bar(file);
    for (uint64_t i = 1; i <= 1000; ++i) bar.Update({i, 1000, "images"});
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
}

}  // namespace
}  // namespace orbweave
