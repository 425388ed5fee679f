// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/join_token.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

constexpr int64_t kNow = 1'800'000'000;

JoinClaims Claims() {
  return {.fleet = "city",
          .role = Role::kWorker,
          .expires_unix_s = kNow + 60,
          .authority_pem = "-----BEGIN\nlines\n-----END\n"};
}

TEST(JoinToken, SaysWhatWasSigned) {
  const std::string key = MakeTokenKey();
  const std::string token = MakeJoinToken(key, Claims());
  const auto claims = VerifyJoinToken(key, token, kNow);
  ASSERT_TRUE(claims.ok()) << claims.status();
  EXPECT_EQ(claims->fleet, "city");
  EXPECT_EQ(claims->role, Role::kWorker);
  EXPECT_EQ(claims->expires_unix_s, kNow + 60);
  EXPECT_EQ(claims->nonce.size(), 32U);
  EXPECT_EQ(claims->authority_pem, Claims().authority_pem);
  EXPECT_EQ(ReadJoinToken(token)->nonce, claims->nonce);
  EXPECT_EQ(token.find('\n'), std::string::npos) << "fits one line, and one variable";
}

TEST(JoinToken, NoTwoAreAlike) {
  const std::string key = MakeTokenKey();
  EXPECT_NE(ReadJoinToken(MakeJoinToken(key, Claims()))->nonce,
            ReadJoinToken(MakeJoinToken(key, Claims()))->nonce);
  EXPECT_NE(MakeTokenKey(), key);
}

TEST(JoinToken, SaysForHowManyItIs) {
  const std::string key = MakeTokenKey();
  JoinClaims claims = Claims();
  EXPECT_EQ(ReadJoinToken(MakeJoinToken(key, claims))->uses, 1U);
  claims.uses = kMostUses;
  EXPECT_EQ(ReadJoinToken(MakeJoinToken(key, claims))->uses, kMostUses);
  for (const uint32_t uses : {0U, kMostUses + 1}) {
    claims.uses = uses;
    EXPECT_FALSE(ReadJoinToken(MakeJoinToken(key, claims)).ok()) << uses;
  }
}

TEST(JoinToken, EndsAtItsTime) {
  const std::string key = MakeTokenKey();
  const std::string token = MakeJoinToken(key, Claims());
  EXPECT_TRUE(VerifyJoinToken(key, token, kNow + 59).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(VerifyJoinToken(key, token, kNow + 60).status()));
}

TEST(JoinToken, IsRefusedUnderAnotherKey) {
  const std::string token = MakeJoinToken(MakeTokenKey(), Claims());
  EXPECT_TRUE(absl::IsPermissionDenied(VerifyJoinToken(MakeTokenKey(), token, kNow).status()));
}

TEST(JoinToken, IsRefusedWhenAnyLetterIsChanged) {
  const std::string key = MakeTokenKey();
  const std::string token = MakeJoinToken(key, Claims());
  // All but the last, which carries bits that say nothing.
  for (size_t i = 0; i + 1 < token.size(); ++i) {
    std::string other = token;
    other[i] = other[i] == 'A' ? 'B' : 'A';
    EXPECT_TRUE(absl::IsPermissionDenied(VerifyJoinToken(key, other, kNow).status())) << i;
  }
}

TEST(JoinToken, RefusesWhatIsNone) {
  const std::string key = MakeTokenKey();
  for (const std::string& text : {std::string(),
                                  std::string("."),
                                  std::string("orbweave-join-2."),
                                  std::string("orbweave-join-2.."),
                                  std::string("orbweave-join-2.YQ.YQ"),
                                  std::string(100'000, 'a')}) {
    EXPECT_TRUE(absl::IsPermissionDenied(VerifyJoinToken(key, text, kNow).status())) << text.size();
    EXPECT_TRUE(absl::IsInvalidArgument(ReadJoinToken(text).status())) << text.size();
  }
}

}  // namespace
}  // namespace orbweave
