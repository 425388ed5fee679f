// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The relay that the chaos script puts between workers and coordinator, with real sockets.

#include "tests/chaos/delaying_relay.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <optional>
#include <thread>

namespace orbweave::testing {
namespace {

constexpr std::chrono::milliseconds kDelay{30};

sockaddr_in Loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// Sends every caller back what it sent, and ends when the caller has.
class Echo {
 public:
  Echo() : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address = Loopback(0);
    socklen_t size = sizeof(address);
    auto* const name = reinterpret_cast<sockaddr*>(&address);
    ORBWEAVE_CHECK(::bind(listener_.get(), name, size) == 0 && ::listen(listener_.get(), 8) == 0);
    ORBWEAVE_CHECK(::getsockname(listener_.get(), name, &size) == 0);
    port_ = ntohs(address.sin_port);
    thread_ = std::jthread([this] {
      for (int caller; (caller = ::accept(listener_.get(), nullptr, nullptr)) >= 0;)
        SendBack(FileDescriptor(caller));
    });
  }
  ~Echo() { ::shutdown(listener_.get(), SHUT_RDWR); }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  static void SendBack(FileDescriptor caller) {
    std::array<char, 4096> buffer;
    for (ssize_t got; (got = ::recv(caller.get(), buffer.data(), buffer.size(), 0)) > 0;)
      ORBWEAVE_CHECK(::send(caller.get(), buffer.data(), static_cast<size_t>(got), MSG_NOSIGNAL) ==
                     got);
  }

  FileDescriptor listener_;
  int port_ = 0;
  std::jthread thread_;
};

class RunningRelay {
 public:
  explicit RunningRelay(const std::string& target)
      : relay_(*DelayingRelay::Start("127.0.0.1:0", target, kDelay)),
        thread_([this](const std::stop_token& stop) { relay_.Run(stop); }) {}

  [[nodiscard]] FileDescriptor Call() const {
    FileDescriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
    const sockaddr_in address = Loopback(relay_.port());
    ORBWEAVE_CHECK(
        ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0);
    return socket;
  }
  uint64_t PiecesAtTheEnd() {
    thread_.request_stop();
    thread_.join();
    return relay_.pieces();
  }

 private:
  DelayingRelay relay_;
  std::jthread thread_;
};

/// Until the other side has ended.
std::string ReadAll(const FileDescriptor& socket) {
  std::string all;
  std::array<char, 65536> buffer;
  for (ssize_t got; (got = ::recv(socket.get(), buffer.data(), buffer.size(), 0)) > 0;)
    all.append(buffer.data(), static_cast<size_t>(got));
  return all;
}

void Send(const FileDescriptor& socket, const std::string& bytes) {
  ORBWEAVE_CHECK(::send(socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
                 static_cast<ssize_t>(bytes.size()));
}

TEST(DelayingRelay, HoldsEveryPieceBackEachWay) {
  const Echo echo;
  RunningRelay relay(echo.address());
  const FileDescriptor socket = relay.Call();
  for (int round = 0; round < 3; ++round) {
    const auto begin = RelayClock::now();
    Send(socket, "ping");
    std::array<char, 4> answer{};
    ASSERT_EQ(::recv(socket.get(), answer.data(), answer.size(), MSG_WAITALL), 4);
    EXPECT_GE(RelayClock::now() - begin, 2 * kDelay);
  }
  EXPECT_EQ(relay.PiecesAtTheEnd(), 6U);
}

TEST(DelayingRelay, KeepsBytesTheirOrderAndTheEnd) {
  const Echo echo;
  RunningRelay relay(echo.address());
  std::string bytes(3'000'000, '\0');
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7 + i / 251);
  const FileDescriptor socket = relay.Call();
  const std::jthread sender([&] {
    Send(socket, bytes);
    ::shutdown(socket.get(), SHUT_WR);
  });
  EXPECT_TRUE(ReadAll(socket) == bytes);
}

TEST(DelayingRelay, TurnsCallersAwayWhileTheTargetIsAway) {
  std::optional<Echo> echo(std::in_place);
  RunningRelay relay(echo->address());
  echo.reset();
  EXPECT_EQ(ReadAll(relay.Call()), "");
}

TEST(DelayingRelay, RefusesWhatIsNoAddress) {
  for (const char* address : {"", "7000", "localhost:7000", "127.0.0.1:70000", "127.0.0.1:x"})
    EXPECT_TRUE(
        absl::IsInvalidArgument(DelayingRelay::Start("127.0.0.1:0", address, kDelay).status()))
        << address;
}

}  // namespace
}  // namespace orbweave::testing
