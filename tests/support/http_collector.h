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
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace orbweave::testing {

/// A server on a port of 127.0.0.1 that keeps what is posted to it and answers what it is told to.
class HttpCollector {
 public:
  /// `port`: 0 takes any free one.
  explicit HttpCollector(uint16_t port = 0)
      : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int yes = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    if (::bind(listener_, reinterpret_cast<const sockaddr*>(&at), size) == 0 &&
        ::listen(listener_, 16) == 0 &&
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&at), &size) == 0) {
      port_ = ntohs(at.sin_port);
    }
    thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
  }
  ~HttpCollector() {
    thread_.request_stop();
    thread_.join();
    ::close(listener_);
  }
  HttpCollector(const HttpCollector&) = delete;
  HttpCollector& operator=(const HttpCollector&) = delete;

  [[nodiscard]] uint16_t port() const { return port_; }
  [[nodiscard]] std::string Url() const { return "http://127.0.0.1:" + std::to_string(port_); }
  /// From now on; empty: it takes connections and never answers.
  void AnswerWith(const std::string& answer) {
    const std::lock_guard lock(mutex_);
    answer_ = answer;
  }
  /// Requests so far, header and body.
  [[nodiscard]] std::vector<std::string> Requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
  }
  /// Their bodies.
  [[nodiscard]] std::vector<std::string> Bodies() const {
    std::vector<std::string> bodies = Requests();
    for (std::string& body : bodies) body.erase(0, body.find("\r\n\r\n") + 4);
    return bodies;
  }

 private:
  void Run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (!IsReadable(listener_)) continue;
      const int caller = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (caller < 0) continue;
      Serve(caller, stop);
      ::close(caller);
    }
  }
  static bool IsReadable(int socket) {
    pollfd look{.fd = socket, .events = POLLIN, .revents = 0};
    return ::poll(&look, 1, 20) == 1;
  }
  /// Whether the header and as many bytes as it promises are there.
  static bool IsWhole(const std::string& request) {
    const size_t end = request.find("\r\n\r\n");
    const size_t length = request.find("Content-Length: ");
    if (end == std::string::npos || length == std::string::npos) return false;
    return request.size() >= end + 4 + std::stoul(request.substr(length + 16));
  }
  void Serve(int caller, const std::stop_token& stop) {
    std::string request;
    while (!stop.stop_requested() && !IsWhole(request)) {
      if (!IsReadable(caller)) continue;
      std::array<char, 65536> piece{};
      const ssize_t n = ::recv(caller, piece.data(), piece.size(), 0);
      if (n <= 0) return;
      request.append(piece.data(), static_cast<size_t>(n));
    }
    std::string answer;
    {
      const std::lock_guard lock(mutex_);
      requests_.push_back(std::move(request));
      answer = answer_;
    }
    while (answer.empty() && !stop.stop_requested() && !IsReadable(caller)) continue;
    (void)::send(caller, answer.data(), answer.size(), MSG_NOSIGNAL);
  }

  int listener_;
  uint16_t port_ = 0;
  mutable std::mutex mutex_;
  std::string answer_ = "HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\n{}";
  std::vector<std::string> requests_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave::testing
