// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/quantile.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(Quantile, IsOneOfTheValues) {
  EXPECT_EQ(Quantile({5.0, 1.0, 3.0}, 0.5), 3.0);
  EXPECT_EQ(Quantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(Quantile({5.0, 1.0, 3.0}, 0.0), 1.0);
  EXPECT_EQ(Quantile({5.0, 1.0, 3.0}, 1.0), 5.0);
}

TEST(Quantile, IsZeroForNothing) { EXPECT_EQ(Quantile({}, 0.5), 0.0); }

}  // namespace
}  // namespace orbweave
