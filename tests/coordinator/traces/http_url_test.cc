// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/http_url.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

TEST(ParseHttpUrl, ReadsHostPortAndTarget) {
  const auto url = ParseHttpUrl("http://collector.example:4318/v1/traces?a=b");
  ASSERT_TRUE(url.ok()) << url.status();
  EXPECT_EQ(url->host, "collector.example");
  EXPECT_EQ(url->port, "4318");
  EXPECT_EQ(url->target, "/v1/traces?a=b");
  EXPECT_EQ(url->ToText(), "http://collector.example:4318/v1/traces?a=b");
}

TEST(ParseHttpUrl, FillsInWhatMayBeMissing) {
  EXPECT_EQ(ParseHttpUrl("http://localhost")->ToText(), "http://localhost:80/");
  EXPECT_EQ(ParseHttpUrl("http://localhost:4318")->target, "/");
  EXPECT_EQ(ParseHttpUrl("http://localhost?x=1")->target, "/?x=1");
}

TEST(ParseHttpUrl, TakesAddressesInBrackets) {
  const auto url = ParseHttpUrl("http://[::1]:4318/");
  ASSERT_TRUE(url.ok()) << url.status();
  EXPECT_EQ(url->host, "::1");
  EXPECT_EQ(url->Authority(), "[::1]:4318");
  EXPECT_EQ(ParseHttpUrl("http://[fe80::1]")->Authority(), "[fe80::1]:80");
}

TEST(ParseHttpUrl, NamesALocalCollectorInPlaceOfHttps) {
  const auto url = ParseHttpUrl("https://tempo.example");
  EXPECT_EQ(url.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(url.status().message()), HasSubstr("a collector on this machine"));
}

TEST(ParseHttpUrl, RepeatsNoPassword) {
  const auto url = ParseHttpUrl("http://user:secret@host:1/");
  EXPECT_EQ(url.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(std::string(url.status().message()).find("secret"), std::string::npos);
}

TEST(ParseHttpUrl, RefusesWhatIsNone) {
  for (const char* text : {"",
                           "localhost:4318",
                           "ftp://localhost",
                           "http://",
                           "http:///path",
                           "http://:4318",
                           "http://host:",
                           "http://host:0",
                           "http://host:65536",
                           "http://host:12345678901234567890",
                           "http://host:4x",
                           "http://a:b:c",
                           "http://::1",
                           "http://[::1",
                           "http://[::1]x",
                           "http://[]:80",
                           "http://user@host",
                           "http://host/#part",
                           "http://ho st/",
                           "http://host/a\r\nX: y",
                           "http://h\xc3\xb6st/"}) {
    EXPECT_EQ(ParseHttpUrl(text).status().code(), absl::StatusCode::kInvalidArgument) << text;
  }
}

}  // namespace
}  // namespace orbweave
