// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <string>
#include <string_view>

namespace orbweave::testing {

/// A connection to 127.x.x.x:port, byte by byte.
class TcpTalk {
 public:
  explicit TcpTalk(const std::string& address, int receive_buffer_bytes = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const size_t colon = address.rfind(':');
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<uint16_t>(std::stoi(address.substr(colon + 1))));
    ::inet_pton(AF_INET, address.substr(0, colon).c_str(), &to.sin_addr);
    if (receive_buffer_bytes > 0) {
      ::setsockopt(
          socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof receive_buffer_bytes);
    }
    is_open_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~TcpTalk() { ::close(socket_); }
  TcpTalk(const TcpTalk&) = delete;
  TcpTalk& operator=(const TcpTalk&) = delete;

  /// Whether the other side took it, or its system did.
  bool Say(std::string_view bytes) {
    while (is_open_ && !bytes.empty()) {
      const ssize_t n = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<size_t>(n));
    }
    return is_open_;
  }
  /// Nothing more will be said.
  void EndSaying() const { ::shutdown(socket_, SHUT_WR); }

  /// What comes until `end` has been heard (with it), the other side closes, or `limit_s` are over.
  std::string HearUntil(std::string_view end, double limit_s = 30.0) {
    const auto over = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
    while (is_open_ && (end.empty() || heard_.find(end) == std::string::npos)) {
      const std::chrono::duration<double, std::milli> left =
          over - std::chrono::steady_clock::now();
      pollfd look{.fd = socket_, .events = POLLIN, .revents = 0};
      if (left.count() <= 0.0) break;
      if (::poll(&look, 1, static_cast<int>(left.count()) + 1) != 1) continue;  // or a signal came
      std::array<char, 65536> piece{};
      const ssize_t n = ::recv(socket_, piece.data(), piece.size(), 0);
      is_open_ = n > 0;
      if (is_open_) heard_.append(piece.data(), static_cast<size_t>(n));
    }
    const size_t found = end.empty() ? std::string::npos : heard_.find(end);
    const size_t taken = found == std::string::npos ? heard_.size() : found + end.size();
    const std::string told = heard_.substr(0, taken);
    heard_.erase(0, taken);
    return told;
  }
  /// What comes until the other side closes.
  std::string HearAll(double limit_s = 30.0) { return HearUntil({}, limit_s); }
  /// Whether the other side has not closed, as far as was heard.
  [[nodiscard]] bool IsOpen() const { return is_open_; }

 private:
  int socket_;
  std::atomic<bool> is_open_{false};  ///< one thread may speak while another hears
  std::string heard_;
};

}  // namespace orbweave::testing
