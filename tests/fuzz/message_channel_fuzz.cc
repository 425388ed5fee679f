// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <sys/socket.h>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"
#include "worker/message_channel.h"

FUZZ_TARGET(message_channel) {
  constexpr size_t kFitsSocket_bytes = 65'536;
  auto ends = orbweave::MessageChannel::MakePair();
  ORBWEAVE_CHECK(ends.ok());
  (void)::send(ends->first.get(), data, std::min(size, kFitsSocket_bytes), MSG_NOSIGNAL);
  ends->first = {};
  orbweave::MessageChannel channel(std::move(ends->second));
  size_t received_bytes = 0;
  while (true) {
    const auto frame = channel.Receive();
    if (!frame.ok()) break;
    received_bytes += frame->message.size() + frame->bulk.View().size();
  }
  ORBWEAVE_CHECK(received_bytes <= size);
}
