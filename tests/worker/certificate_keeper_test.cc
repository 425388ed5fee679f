// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/certificate_keeper.h"

#include <gtest/gtest.h>

#include <atomic>

#include "security/key_store.h"
#include "tests/support/command.h"

namespace orbweave {
namespace {

constexpr int64_t kDay_s = 86400;

TEST(IsDueForRenewal, WhenLessThanAThirdIsLeft) {
  const CertificateFacts day{.begins_unix_s = 0, .ends_unix_s = kDay_s};
  EXPECT_FALSE(IsDueForRenewal(day, kDay_s * 2 / 3));
  EXPECT_TRUE(IsDueForRenewal(day, kDay_s * 2 / 3 + 1));
  EXPECT_TRUE(IsDueForRenewal(day, kDay_s + 1)) << "ended: it is tried all the same";
}

TEST(IsDueForRenewal, NeverALongOne) {
  const CertificateFacts year{.begins_unix_s = 0, .ends_unix_s = 365 * kDay_s};
  EXPECT_FALSE(IsDueForRenewal(year, 365 * kDay_s - 1));
}

TEST(CertificateKeeper, RenewsInTimeAndTriesAgainAfterAFailure) {
  const testing::TemporaryFolder folder;
  const std::string store = folder / "keys";
  std::atomic<int64_t> now{1'800'000'000};
  ASSERT_TRUE(MakeKeyStore(store, "city", {}, now).ok());
  ASSERT_TRUE(AddKeys(store, {.name = "node", .valid_s = kDay_s}, now).ok());
  std::atomic<int> attempts{0};
  const CertificateKeeper keeper({.folder = {store + "/node"},
                                  .look_s = 0.01,
                                  .now_unix_s = [&now] { return now.load(); },
                                  .renew = [&attempts]() -> absl::Status {
                                    ++attempts;
                                    return absl::UnavailableError("nobody there");
                                  }});
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(attempts, 0);
  now += kDay_s * 3 / 4;
  EXPECT_TRUE(testing::WaitUntil([&attempts] { return attempts > 1; }, 20.0));
}

}  // namespace
}  // namespace orbweave
