// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "core/base/file_descriptor.h"
#include "core/base/status.h"
#include "worker/shared_bytes.h"

namespace orbweave {

/// A message with bulk bytes beside it.
struct Frame {
  std::string message{};
  SharedBytes bulk{};
};

/// One end of a connection between two processes of this machine that carries frames: their sizes,
/// the message, and the bulk as bytes or, when it lies in a memory file, as that file. One sender
/// and one receiver at a time.
class MessageChannel {
 public:
  /// With `timeout_s` > 0, waiting for the rest of a frame that has begun ends after so long.
  explicit MessageChannel(FileDescriptor socket, double timeout_s = 0.0);

  /// Two connected sockets. Unavailable: the system has no more.
  [[nodiscard]] static absl::StatusOr<std::pair<FileDescriptor, FileDescriptor>> MakePair();

  /// Unavailable: the other end is closed. DeadlineExceeded: it does not take the frame.
  [[nodiscard]] absl::Status Send(std::string_view message, const SharedBytes& bulk = {});
  /// Waits for the next frame. Unavailable: the other end is closed. DeadlineExceeded: a frame
  /// stopped in the middle. DataLoss: no frame.
  [[nodiscard]] absl::StatusOr<Frame> Receive();

  [[nodiscard]] int descriptor() const { return socket_.get(); }

 private:
  [[nodiscard]] absl::Status SendAll(std::string_view bytes);
  [[nodiscard]] absl::Status ReceiveAll(void* bytes, size_t size);
  [[nodiscard]] absl::StatusOr<std::string> ReceiveText(size_t size);

  FileDescriptor socket_;
};

}  // namespace orbweave
