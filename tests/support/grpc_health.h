// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <memory>
#include <string>

#include "tests/support/grpc_raw_call.h"

namespace orbweave::testing {

enum class Health { kNoAnswer, kServing, kOther };

/// Asks grpc.health.v1.Health/Check for the server as a whole. Its messages are small enough to be
/// read by hand: the request is empty, SERVING is the value 1 of field 1.
inline Health AskHealth(const std::shared_ptr<grpc::Channel>& channel) {
  const RawAnswer answer = RawCall(channel, "/grpc.health.v1.Health/Check", "");
  if (!answer.status.ok()) return Health::kNoAnswer;
  return answer.bytes == "\x08\x01" ? Health::kServing : Health::kOther;
}

/// Without encryption.
inline Health AskHealth(const std::string& address) {
  return AskHealth(grpc::CreateChannel(address, grpc::InsecureChannelCredentials()));
}

}  // namespace orbweave::testing
