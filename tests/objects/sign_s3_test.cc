// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/sign_s3.h"

#include <gtest/gtest.h>

#include "core/base/digest.h"

namespace orbweave {
namespace {

// The examples of "Signature Calculations for the Authorization Header" and "Authenticating
// Requests: Using Query Parameters" in the Amazon S3 API reference.
const S3Keys kExampleKeys{.access_key = "AKIAIOSFODNN7EXAMPLE",
                          .secret_key = "wJalrXUtnFEMI/K7MDENG/bPxRfiCYEXAMPLEKEY",
                          .region = "us-east-1"};
constexpr char kExampleTime[] = "20130524T000000Z";
constexpr char kExampleHost[] = "examplebucket.s3.amazonaws.com";
constexpr int64_t kExampleUnix_s = 1369353600;

std::string Sign(S3Request request, const std::string& body) {
  const std::string hash = DigestOf(body).ToHex();
  request.host = kExampleHost;
  request.headers["x-amz-date"] = kExampleTime;
  request.headers["x-amz-content-sha256"] = hash;
  return SignatureOf(request, hash, kExampleKeys, kExampleTime);
}

TEST(SignatureOf, IsThatOfAmazonsExampleOfGet) {
  EXPECT_EQ(Sign({.path = "/test.txt", .headers = {{"range", "bytes=0-9"}}}, ""),
            "f0e8bdb87c964420e857bd35b5d6ed310bd44f0170aba48dd91039c6036bdb41");
}

TEST(SignatureOf, IsThatOfAmazonsExampleOfPut) {
  EXPECT_EQ(Sign({.method = "PUT",
                  .path = "/test%24file.text",
                  .headers = {{"date", "Fri, 24 May 2013 00:00:00 GMT"},
                              {"x-amz-storage-class", "REDUCED_REDUNDANCY"}}},
                 "Welcome to Amazon S3."),
            "98ad721746da40c64f1a55b78f14c238d841ea1380cd77a1b5971af0ece108bd");
}

TEST(SignatureOf, IsThatOfAmazonsExampleOfAQueryWithoutValue) {
  EXPECT_EQ(Sign({.query = {{"lifecycle", ""}}}, ""),
            "fea454ca298b7da1c68078a5d1bdbfbbe0d65c699e0f91ac7a200a0136783543");
}

TEST(SignatureOf, IsThatOfAmazonsExampleOfAList) {
  EXPECT_EQ(Sign({.query = {{"max-keys", "2"}, {"prefix", "J"}}}, ""),
            "34b48302e7b5fa45bde8084f4b7868a86f0a534bc59db6670ed5711ef69dc6f7");
}

TEST(Presign, IsThatOfAmazonsExample) {
  EXPECT_EQ(
      Presign({.host = kExampleHost, .path = "/test.txt"}, kExampleKeys, kExampleUnix_s, 86400),
      "/test.txt?X-Amz-Algorithm=AWS4-HMAC-SHA256"
      "&X-Amz-Credential=AKIAIOSFODNN7EXAMPLE%2F20130524%2Fus-east-1%2Fs3%2Faws4_request"
      "&X-Amz-Date=20130524T000000Z&X-Amz-Expires=86400&X-Amz-SignedHeaders=host"
      "&X-Amz-Signature=aeeed9bbccd4d02ee5c0109b86d86835f995330da4c265957d157751f604d404");
}

TEST(Presign, SignsTheHeadersTheDigestAndTheSessionToken) {
  S3Keys keys = kExampleKeys;
  const S3Request plain{.method = "PUT", .host = kExampleHost, .path = "/a"};
  const std::string before = Presign(plain, keys, kExampleUnix_s, 600);
  S3Request with_hash = plain;
  with_hash.headers["x-amz-content-sha256"] = DigestOf("a").ToHex();
  const std::string hashed = Presign(with_hash, keys, kExampleUnix_s, 600);
  EXPECT_NE(hashed.find("X-Amz-SignedHeaders=host%3Bx-amz-content-sha256&"), std::string::npos);
  with_hash.headers["x-amz-content-sha256"] = DigestOf("b").ToHex();
  EXPECT_NE(hashed, Presign(with_hash, keys, kExampleUnix_s, 600));
  keys.session_token = "token/+";
  const std::string with_token = Presign(plain, keys, kExampleUnix_s, 600);
  EXPECT_NE(with_token.find("X-Amz-Security-Token=token%2F%2B"), std::string::npos);
  const auto signature = [](const std::string& url) { return url.substr(url.rfind('=')); };
  EXPECT_NE(signature(before), signature(with_token));
  EXPECT_EQ(before.find(keys.secret_key), std::string::npos);
}

TEST(TimeOfS3, IsUtc) {
  EXPECT_EQ(TimeOfS3(kExampleUnix_s), kExampleTime);
  EXPECT_EQ(TimeOfS3(0), "19700101T000000Z");
}

}  // namespace
}  // namespace orbweave
