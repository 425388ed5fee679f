// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <grpcpp/support/server_callback.h>

#include <functional>
#include <memory>
#include <stop_token>

#include "coordinator/served_api.h"
#include "coordinator/standing_calls.h"
#include "orbweave/v1/coordinator.pb.h"

namespace orbweave {

/// One call of LeaseTask, which has no thread while it waits. It ends as soon as its caller has
/// left, and destroys itself.
class GrpcLeaseCall final : public grpc::ServerUnaryReactor {
 public:
  /// `request` and `reply` live until OnDone.
  GrpcLeaseCall(ServedApi& api, const v1::LeaseTaskRequest& request, v1::LeaseTaskReply& reply)
      : api_(api), request_(request), reply_(reply) {}

  /// Ends its wait; may be called whenever, also when it is gone.
  [[nodiscard]] std::function<void()> CallOff() const {
    return [left = left_]() mutable { left.request_stop(); };
  }
  /// To be called once; the call may be answered before it returns. `standing`: null where the peer
  /// is trusted; one who is shut out meanwhile is told so, and gets no task.
  void Ask(std::unique_ptr<StandingCalls::Call> standing);
  void OnCancel() override { left_.request_stop(); }
  void OnDone() override { delete this; }

 private:
  void Answer(const absl::StatusOr<std::optional<Lease>>& lease);

  ServedApi& api_;
  const v1::LeaseTaskRequest& request_;
  v1::LeaseTaskReply& reply_;
  std::stop_source left_;
  std::unique_ptr<StandingCalls::Call> standing_;
};

}  // namespace orbweave
