// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/security/credentials.h>

#include <chrono>
#include <future>
#include <string>
#include <vector>

namespace orbweave::testing {

enum class Health { kNoAnswer, kServing, kOther };

/// Asks grpc.health.v1.Health/Check for the server as a whole. Its messages are small enough to be
/// read by hand: the request is empty, SERVING is the value 1 of field 1.
inline Health AskHealth(const std::string& address) {
  grpc::GenericStub stub(grpc::CreateChannel(address, grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  const grpc::Slice nothing("");
  const grpc::ByteBuffer request(&nothing, 1);
  grpc::ByteBuffer reply;
  std::promise<grpc::Status> done;
  stub.UnaryCall(
      &context, "/grpc.health.v1.Health/Check", {}, &request, &reply, [&done](grpc::Status status) {
        done.set_value(std::move(status));
      });
  if (!done.get_future().get().ok()) return Health::kNoAnswer;
  std::vector<grpc::Slice> slices;
  (void)reply.Dump(&slices);
  std::string bytes;
  for (const grpc::Slice& slice : slices) bytes.append(slice.begin(), slice.end());
  return bytes == "\x08\x01" ? Health::kServing : Health::kOther;
}

}  // namespace orbweave::testing
