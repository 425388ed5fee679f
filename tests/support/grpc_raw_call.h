// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/generic/generic_stub.h>

#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace orbweave::testing {

struct RawAnswer {
  grpc::Status status{};
  std::string bytes{};
};

/// What becomes of a call of "/package.Service/Method" whose message is `bytes`, be they one or
/// not.
inline RawAnswer RawCall(const std::shared_ptr<grpc::Channel>& channel,
                         const std::string& method,
                         const std::string& bytes) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  const grpc::Slice slice(bytes);
  const grpc::ByteBuffer request(&slice, 1);
  grpc::ByteBuffer reply;
  std::promise<grpc::Status> done;
  stub.UnaryCall(&context, method, {}, &request, &reply, [&done](grpc::Status status) {
    done.set_value(std::move(status));
  });
  RawAnswer answer{.status = done.get_future().get()};
  std::vector<grpc::Slice> slices;
  if (answer.status.ok()) (void)reply.Dump(&slices);
  for (const grpc::Slice& piece : slices) answer.bytes.append(piece.begin(), piece.end());
  return answer;
}

}  // namespace orbweave::testing
