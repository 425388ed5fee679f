// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "security/identity.h"
#include "security/revocations.h"

namespace orbweave {

/// Calls that last: streams of blobs, and those that wait for a task. Whoever is shut out while one
/// goes on loses it within a second or two. Thread-safe.
class StandingCalls {
 public:
  /// Whose call it is.
  struct Peer {
    Identity identity{};
    std::string certificate_pem{};
  };

  /// A call that goes on; it ends with this.
  class Call {
   public:
    Call(StandingCalls& calls, Peer peer, std::function<void()> call_off);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    /// PermissionDenied: its peer is shut out by now.
    [[nodiscard]] absl::Status Check() const;

   private:
    friend class StandingCalls;
    StandingCalls& calls_;
    const Peer peer_;
    std::function<void()> call_off_;
    std::list<Call*>::iterator place_;
  };

  explicit StandingCalls(std::shared_ptr<RevocationList> revocations);

  /// `call_off` makes the call end; it is called once at most, and not after the call has ended.
  [[nodiscard]] std::unique_ptr<Call> Begin(Peer peer, std::function<void()> call_off);

 private:
  void CallOffTheRevoked(const std::stop_token& stop);

  const std::shared_ptr<RevocationList> revocations_;
  std::mutex mutex_;
  std::list<Call*> calls_;
  std::condition_variable_any woken_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
