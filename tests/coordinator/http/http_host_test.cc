// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/http_host.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(NamesThisHost, TakesTheLoopbackAndWhatIsListenedOnWithAnyPort) {
  for (const char* header : {"localhost",
                             "LocalHost:9464",
                             "localhost:",
                             "127.0.0.1",
                             "127.0.0.1:1",
                             "[::1]",
                             "[::1]:9464",
                             "127.0.0.7:80",
                             "127.0.0.7"}) {
    EXPECT_TRUE(NamesThisHost(header, "127.0.0.7")) << header;
  }
}

TEST(NamesThisHost, TakesNoOther) {
  for (const char* header : {"",
                             ":",
                             ":80",
                             "evil.example",
                             "evil.example:9464",
                             "localhost.evil.example",
                             "127.0.0.1.evil.example",
                             "127.0.0.8",
                             "localhost:80:80",
                             "localhost:80@evil.example",
                             "evil.example@localhost",
                             "localhost ",
                             "[::1",
                             "[::1]x",
                             "[::1]x:80",
                             "::1",
                             "[",
                             "]"}) {
    EXPECT_FALSE(NamesThisHost(header, "127.0.0.7")) << header;
  }
}

}  // namespace
}  // namespace orbweave
