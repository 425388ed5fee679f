// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/server_context.h>

#include <condition_variable>
#include <list>
#include <mutex>
#include <stop_token>
#include <thread>

namespace orbweave {

/// Notices callers that leave while their call waits for something: a handler of its own learns of
/// it only when it asks. Thread-safe.
class GrpcCallWatch {
 public:
  GrpcCallWatch() : thread_([this](const std::stop_token& stop) { Run(stop); }) {}

  /// What `call(left)` returns; `left` is requested once the caller of `context` has left.
  template <typename Call>
  auto During(const grpc::ServerContext& context, Call&& call) {
    const Watched watched(*this, context);
    return call(watched.entry->left.get_token());
  }

 private:
  struct Entry {
    const grpc::ServerContext* context = nullptr;
    std::stop_source left{};
  };
  struct Watched {
    Watched(GrpcCallWatch& in, const grpc::ServerContext& context);
    ~Watched();
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;
    GrpcCallWatch& watch;
    std::list<Entry>::iterator entry{};
  };
  void Run(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::list<Entry> calls_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
