// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <grpcpp/support/server_callback.h>

#include <stop_token>

#include "coordinator/served_api.h"
#include "orbweave/v1/coordinator.pb.h"

namespace orbweave {

/// One call of LeaseTask, which has no thread while it waits. It ends as soon as its caller has
/// left, and destroys itself.
class GrpcLeaseCall final : public grpc::ServerUnaryReactor {
 public:
  /// `request` and `reply` live until OnDone.
  GrpcLeaseCall(ServedApi& api, const v1::LeaseTaskRequest& request, v1::LeaseTaskReply& reply)
      : api_(api), request_(request), reply_(reply) {}

  /// To be called once; the call may be answered before it returns.
  void Ask();
  void OnCancel() override { left_.request_stop(); }
  void OnDone() override { delete this; }

 private:
  void Answer(const absl::StatusOr<std::optional<Lease>>& lease);

  ServedApi& api_;
  const v1::LeaseTaskRequest& request_;
  v1::LeaseTaskReply& reply_;
  std::stop_source left_;
};

}  // namespace orbweave
