// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/build_version.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/digest.h"

namespace orbweave {
namespace {

TEST(BuildVersion, NamesTheReleaseAndThisVeryExecutable) {
  const std::string version(BuildVersion());
  EXPECT_THAT(version, ::testing::StartsWith("0."));
  EXPECT_THAT(version, ::testing::EndsWith("+" + DigestOfFile("/proc/self/exe")->ToShortHex()));
  EXPECT_EQ(version, BuildVersion());
}

}  // namespace
}  // namespace orbweave
