// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "proto/codec/coordinator_codec.h"
#include "proto/codec/grants_codec.h"
#include "tests/fuzz/round_trip.h"

namespace orbweave {

/// CheckRoundTrip for a message of the wire, from its bytes to the word of core/pipeline and back.
template <typename Message>
void CheckMessageRoundTrip(std::string_view bytes) {
  const auto decode = [](std::string_view encoded) {
    using Value = decltype(FromProto(Message()));
    Message message;
    const bool is_message =
        message.ParseFromArray(encoded.data(), static_cast<int>(encoded.size()));
    if constexpr (requires { Value().status(); }) {
      return is_message ? FromProto(message) : Value(absl::DataLossError("no message"));
    } else {
      return is_message ? absl::StatusOr<Value>(FromProto(message))
                        : absl::StatusOr<Value>(absl::DataLossError("no message"));
    }
  };
  CheckRoundTrip(
      bytes, decode, [](const auto& value) { return ToProto(value).SerializeAsString(); });
}

}  // namespace orbweave
