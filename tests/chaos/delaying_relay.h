// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <list>
#include <memory>
#include <stop_token>
#include <string>

#include "core/base/file_descriptor.h"
#include "core/base/status.h"

namespace orbweave::testing {

using RelayClock = std::chrono::steady_clock;

/// One direction of a connection: hands on what it reads `delay` later, in order, and the end of it
/// too. Reads on meanwhile, up to 64 MiB ahead, so that latency is all that it adds.
class DelayedPipe {
 public:
  DelayedPipe(int from, int to, RelayClock::duration delay) : from_(from), to_(to), delay_(delay) {}

  [[nodiscard]] bool MayRead() const;
  /// Whether something is due that `to` did not take.
  [[nodiscard]] bool IsBlocked() const { return is_blocked_; }
  /// When it has to hand something on next; max: nothing is held.
  [[nodiscard]] RelayClock::time_point NextDue() const;
  /// All is handed on, or cannot be any more.
  [[nodiscard]] bool IsDone() const { return is_done_; }
  /// The number of pieces read so far.
  [[nodiscard]] uint64_t pieces() const { return pieces_; }

  void Read(RelayClock::time_point now);
  void Write(RelayClock::time_point now);

 private:
  struct Piece {
    RelayClock::time_point due{};
    std::string bytes{};  ///< none: the end
  };

  int from_;
  int to_;
  RelayClock::duration delay_;
  std::deque<Piece> held_{};
  size_t held_bytes_ = 0;
  size_t written_ = 0;  ///< bytes of the first piece
  uint64_t pieces_ = 0;
  bool has_ended_ = false;
  bool is_blocked_ = false;
  bool is_done_ = false;
};

/// Stands for a network with latency where the kernel has none to offer: forwards TCP connections.
class DelayingRelay {
 public:
  /// Listens on `listen` and connects whoever comes with `target`, both "IPv4 address:port"; port 0
  /// lets the system choose. InvalidArgument, Unavailable.
  [[nodiscard]] static absl::StatusOr<DelayingRelay> Start(const std::string& listen,
                                                           const std::string& target,
                                                           RelayClock::duration delay);

  [[nodiscard]] int port() const { return port_; }
  /// Pieces held back so far; before or after Run.
  [[nodiscard]] uint64_t pieces() const { return pieces_; }

  /// Forwards until `stop`. Who comes while the target is away is turned away.
  void Run(const std::stop_token& stop);

 private:
  struct Connection {
    FileDescriptor caller{};
    FileDescriptor target{};
    DelayedPipe up;
    DelayedPipe down;
  };

  DelayingRelay() = default;
  void Accept();
  void Poll();
  void Advance();

  FileDescriptor listener_{};
  int port_ = 0;
  std::string target_{};
  RelayClock::duration delay_{};
  std::list<Connection> connections_{};
  uint64_t pieces_ = 0;
};

}  // namespace orbweave::testing
