// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

TEST(ParseS3Address, TakesAmazonsWithTheBucketInTheHost) {
  S3Address address = *ParseS3Address("s3://city-blobs/orbweave/a?region=eu-central-1");
  EXPECT_EQ(address.bucket, "city-blobs");
  EXPECT_EQ(address.prefix, "orbweave/a");
  EXPECT_EQ(address.region, "eu-central-1");
  EXPECT_EQ(address.host, "");
  address.host = "s3.example";
  EXPECT_EQ(address.HostOfBucket(), "city-blobs.s3.example");
  EXPECT_EQ(address.PathOf("ab c"), "/orbweave/a/ab%20c");
  EXPECT_EQ(address.PathOf(""), "/");
  EXPECT_EQ(address.ToText(), "s3://city-blobs/orbweave/a");
}

TEST(ParseS3Address, TakesAnEndpointWithTheBucketInThePath) {
  const S3Address address = *ParseS3Address("s3://blobs?endpoint=https://rgw.example:7480/");
  EXPECT_EQ(address.scheme, "https");
  EXPECT_EQ(address.HostOfBucket(), "rgw.example:7480");
  EXPECT_EQ(address.PathOf("x"), "/blobs/x");
  EXPECT_EQ(address.PathOf(""), "/blobs");
  EXPECT_EQ(ParseS3Address("s3://blobs?endpoint=https://a.example&style=host")->HostOfBucket(),
            "blobs.a.example");
  EXPECT_EQ(ParseS3Address("s3://blobs?endpoint=https%3A%2F%2Fa.example")->host, "a.example");
}

TEST(ParseS3Address, DropsSlashesAroundThePrefix) {
  EXPECT_EQ(ParseS3Address("s3://blobs//a/b//")->prefix, "a/b");
  EXPECT_EQ(ParseS3Address("s3://blobs/")->prefix, "");
}

TEST(ParseS3Address, TakesHttpOnTheLoopbackOnlyUnlessToldOtherwise) {
  for (const char* host : {"127.0.0.1:9000", "localhost", "[::1]:80"})
    EXPECT_TRUE(ParseS3Address(std::string("s3://blobs?endpoint=http://") + host).ok()) << host;
  for (const char* host : {"10.0.0.1:9000", "localhost.example", "rgw"}) {
    const auto refused = ParseS3Address(std::string("s3://blobs?endpoint=http://") + host);
    EXPECT_THAT(std::string(refused.status().message()), HasSubstr("plain=yes")) << host;
  }
  EXPECT_TRUE(ParseS3Address("s3://blobs?endpoint=http://10.0.0.1:9000&plain=yes").ok());
}

TEST(ParseS3Address, RefusesOtherForms) {
  for (const char* text : {"",
                           "s3:/blobs",
                           "http://blobs",
                           "s3://",
                           "s3://Blobs",
                           "s3://a_b/",
                           "s3://blobs?endpoint=ftp://x",
                           "s3://blobs?endpoint=",
                           "s3://blobs?endpoint=https://",
                           "s3://blobs?endpoint=https://a/b",
                           "s3://blobs?endpoint=https://user@a",
                           "s3://blobs?region=a/b",
                           "s3://blobs?style=other",
                           "s3://blobs?reigon=x",
                           "s3://blobs?region=%4"}) {
    EXPECT_TRUE(absl::IsInvalidArgument(ParseS3Address(text).status())) << text;
  }
}

TEST(UriEncode, EncodesEveryByteButTheUnreservedOnes) {
  EXPECT_EQ(UriEncode("aZ09-._~", false), "aZ09-._~");
  EXPECT_EQ(UriEncode("a/b $\xc3\xa4", false), "a%2Fb%20%24%C3%A4");
  EXPECT_EQ(UriEncode("a/b+", true), "a/b%2B");
}

TEST(UriDecode, IsTheInverseOfUriEncode) {
  std::string bytes;
  for (int c = 0; c < 256; ++c) bytes += static_cast<char>(c);
  EXPECT_EQ(*UriDecode(UriEncode(bytes, false)), bytes);
  EXPECT_EQ(*UriDecode(UriEncode(bytes, true)), bytes);
  for (const char* text : {"%", "%4", "a%zz", "% 1", "%+1"})
    EXPECT_FALSE(UriDecode(text).ok()) << text;
}

}  // namespace
}  // namespace orbweave
