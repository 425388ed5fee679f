// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/listen_address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(CheckListenAddress, AllowsSocketsAndLoopback) {
  for (const char* address :
       {"unix:/tmp/x.sock", "127.0.0.1:0", "127.1.2.3:7000", "localhost:7000", "[::1]:7000"}) {
    EXPECT_TRUE(CheckListenAddress(address, Wire::kPlain).ok()) << address;
  }
}

TEST(CheckListenAddress, RefusesOtherHostsAndSaysWhy) {
  for (const char* address :
       {"0.0.0.0:7000", "192.168.1.5:7000", "[::]:7000", "127.0.0.1.example.com:1", "host:1"}) {
    const absl::Status status = CheckListenAddress(address, Wire::kPlain);
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << address;
    EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("TLS")) << address;
  }
}

TEST(CheckListenAddress, AllowsEveryHostWhereTheWireIsEncrypted) {
  for (const char* address : {"0.0.0.0:7000", "[::]:0", "host:1", "127.0.0.1:7000"}) {
    EXPECT_TRUE(CheckListenAddress(address, Wire::kEncrypted).ok()) << address;
  }
  EXPECT_TRUE(absl::IsInvalidArgument(CheckListenAddress("unix:/tmp/s", Wire::kEncrypted)));
}

TEST(CheckListenAddress, RefusesWhatIsNoAddress) {
  for (const std::string& address : {std::string("7000"),
                                     std::string("127.0.0.1"),
                                     std::string("127.0.0.1:x"),
                                     std::string("127.0.0.1:70000"),
                                     std::string("unix:"),
                                     "unix:/" + std::string(200, 'x')}) {
    EXPECT_TRUE(absl::IsInvalidArgument(CheckListenAddress(address, Wire::kPlain))) << address;
  }
}

}  // namespace
}  // namespace orbweave
