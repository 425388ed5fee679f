// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc_call_watch.h"

#include <chrono>

namespace orbweave {
namespace {

/// How long a caller may have left before it is noticed. To ask gRPC is a call of the system: ten
/// times a second it cost more than all else that a thousand waiting calls do.
constexpr std::chrono::seconds kLook{1};

}  // namespace

GrpcCallWatch::Watched::Watched(GrpcCallWatch& in, const grpc::ServerContext& context) : watch(in) {
  const std::lock_guard lock(watch.mutex_);
  entry = watch.calls_.insert(watch.calls_.end(), Entry{.context = &context});
  watch.changed_.notify_one();
}

GrpcCallWatch::Watched::~Watched() {
  const std::lock_guard lock(watch.mutex_);
  watch.calls_.erase(entry);
}

void GrpcCallWatch::Run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !calls_.empty(); })) {
    for (Entry& call : calls_) {
      if (call.context->IsCancelled()) call.left.request_stop();
    }
    changed_.wait_for(lock, stop, kLook, [] { return false; });
  }
}

}  // namespace orbweave
