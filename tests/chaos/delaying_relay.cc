// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/chaos/delaying_relay.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/numbers.h"

namespace orbweave::testing {
namespace {

constexpr size_t kMostHeld_bytes = size_t{64} << 20;
constexpr std::chrono::milliseconds kLook{50};

std::optional<sockaddr_in> ParseAddress(const std::string& text) {
  const size_t colon = text.rfind(':');
  sockaddr_in address{};
  uint32_t port = 0;
  if (colon == std::string::npos || !absl::SimpleAtoi(text.substr(colon + 1), &port) ||
      port > 65535 || ::inet_pton(AF_INET, text.substr(0, colon).c_str(), &address.sin_addr) != 1) {
    return std::nullopt;
  }
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  return address;
}

/// Pieces go on as they come.
FileDescriptor WithoutWaiting(FileDescriptor socket) {
  constexpr int kOn = 1;
  ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &kOn, sizeof(kOn));
  ::fcntl(socket.get(), F_SETFL, O_NONBLOCK);
  return socket;
}

/// None: nobody is there.
FileDescriptor ConnectTo(const sockaddr_in& address) {
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    return {};
  return WithoutWaiting(std::move(socket));
}

bool WouldBlock() { return errno == EAGAIN || errno == EINTR; }

}  // namespace

bool DelayedPipe::MayRead() const { return !has_ended_ && held_bytes_ < kMostHeld_bytes; }

RelayClock::time_point DelayedPipe::NextDue() const {
  return held_.empty() || is_blocked_ ? RelayClock::time_point::max() : held_.front().due;
}

void DelayedPipe::Read(RelayClock::time_point now) {
  std::array<char, 65536> buffer;
  const ssize_t got = ::recv(from_, buffer.data(), buffer.size(), 0);
  if (got < 0 && WouldBlock()) return;
  has_ended_ = got <= 0;
  held_.push_back(
      {now + delay_, std::string(buffer.data(), static_cast<size_t>(std::max<ssize_t>(got, 0)))});
  held_bytes_ += held_.back().bytes.size();
  ++pieces_;
}

void DelayedPipe::Write(RelayClock::time_point now) {
  is_blocked_ = false;
  while (!held_.empty() && held_.front().due <= now && !is_done_) {
    const std::string& bytes = held_.front().bytes;
    if (bytes.empty()) {
      ::shutdown(to_, SHUT_WR);
      is_done_ = true;
      return;
    }
    const ssize_t sent =
        ::send(to_, bytes.data() + written_, bytes.size() - written_, MSG_NOSIGNAL);
    if (sent < 0) {
      is_blocked_ = WouldBlock();
      is_done_ = !is_blocked_;
      return;
    }
    written_ += static_cast<size_t>(sent);
    if (written_ < bytes.size()) continue;
    held_bytes_ -= bytes.size();
    held_.pop_front();
    written_ = 0;
  }
}

absl::StatusOr<DelayingRelay> DelayingRelay::Start(const std::string& listen,
                                                   const std::string& target,
                                                   RelayClock::duration delay) {
  std::optional<sockaddr_in> address = ParseAddress(listen);
  if (!address || !ParseAddress(target))
    return absl::InvalidArgumentError("addresses are IPv4 ones with a port: 127.0.0.1:7000");
  DelayingRelay relay;
  relay.target_ = target;
  relay.delay_ = delay;
  relay.listener_ = FileDescriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  constexpr int kOn = 1;
  ::setsockopt(relay.listener_.get(), SOL_SOCKET, SO_REUSEADDR, &kOn, sizeof(kOn));
  auto* const name = reinterpret_cast<sockaddr*>(&*address);
  socklen_t size = sizeof(*address);
  if (::bind(relay.listener_.get(), name, size) != 0 || ::listen(relay.listener_.get(), 64) != 0 ||
      ::getsockname(relay.listener_.get(), name, &size) != 0) {
    return absl::UnavailableError("cannot listen on " + listen);
  }
  relay.port_ = ntohs(address->sin_port);
  return relay;
}

void DelayingRelay::Accept() {
  FileDescriptor caller(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  if (!caller.IsOpen()) return;
  FileDescriptor target = ConnectTo(*ParseAddress(target_));
  if (!target.IsOpen()) return;
  const int from = caller.get();
  const int to = target.get();
  connections_.push_back({WithoutWaiting(std::move(caller)),
                          std::move(target),
                          DelayedPipe(from, to, delay_),
                          DelayedPipe(to, from, delay_)});
}

void DelayingRelay::Poll() {
  std::vector<pollfd> files = {{listener_.get(), POLLIN, 0}};
  RelayClock::time_point next = RelayClock::now() + kLook;
  const auto watch = [&files](int file, const DelayedPipe& reads, const DelayedPipe& writes) {
    const int events = (reads.MayRead() ? POLLIN : 0) | (writes.IsBlocked() ? POLLOUT : 0);
    files.push_back({events == 0 ? -1 : file, static_cast<int16_t>(events), 0});
  };
  for (const Connection& each : connections_) {
    watch(each.caller.get(), each.up, each.down);
    watch(each.target.get(), each.down, each.up);
    next = std::min({next, each.up.NextDue(), each.down.NextDue()});
  }
  const auto wait =
      std::chrono::ceil<std::chrono::milliseconds>(std::max(next - RelayClock::now(), {}));
  ::poll(files.data(), files.size(), static_cast<int>(wait.count()));
  size_t file = 1;
  for (Connection& each : connections_) {
    for (DelayedPipe* pipe : {&each.up, &each.down}) {
      if (files[file++].revents != 0 && pipe->MayRead()) pipe->Read(RelayClock::now());
    }
  }
  if (files.front().revents != 0) Accept();
}

void DelayingRelay::Advance() {
  for (auto each = connections_.begin(); each != connections_.end();) {
    each->up.Write(RelayClock::now());
    each->down.Write(RelayClock::now());
    if (each->up.IsDone() && each->down.IsDone()) {
      pieces_ += each->up.pieces() + each->down.pieces();
      each = connections_.erase(each);
    } else {
      ++each;
    }
  }
}

void DelayingRelay::Run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Poll();
    Advance();
  }
  for (const Connection& each : connections_) pieces_ += each.up.pieces() + each.down.pieces();
  connections_.clear();
}

}  // namespace orbweave::testing
