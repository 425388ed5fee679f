// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc/grpc_lease_call.h"

#include <utility>

#include "coordinator/grpc/grpc_status.h"
#include "proto/codec/coordinator_codec.h"

namespace orbweave {

void GrpcLeaseCall::Ask(std::unique_ptr<StandingCalls::Call> standing) {
  standing_ = std::move(standing);
  api_.AskForTask(request_.session(),
                  request_.slot(),
                  request_.wait_s(),
                  left_.get_token(),
                  [this](const absl::StatusOr<std::optional<Lease>>& lease) { Answer(lease); });
}

void GrpcLeaseCall::Answer(const absl::StatusOr<std::optional<Lease>>& lease) {
  const absl::Status may_have_it = standing_ ? standing_->Check() : absl::OkStatus();
  if (absl::IsPermissionDenied(may_have_it)) {
    if (lease.ok() && *lease) {
      api_.FailTask(request_.session(), **lease, absl::CancelledError("the worker is shut out"))
          .IgnoreError();  // the lease may have ended meanwhile
    }
    return Finish(OnWire(may_have_it));
  }
  if (!lease.ok()) return Finish(OnWire(lease.status()));
  if (*lease && left_.stop_requested()) {  // nobody is there to take it
    return Finish(OnWire(
        api_.FailTask(request_.session(), **lease, absl::CancelledError("the worker hung up"))));
  }
  if (*lease) *reply_.mutable_lease() = ToProto(**lease);
  Finish(grpc::Status::OK);
}

}  // namespace orbweave
