// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/message_channel.h"

#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

struct Header {
  uint64_t message_bytes = 0;
  uint64_t bulk_bytes = 0;  ///< that follow the message
  uint64_t has_file = 0;    ///< 1: the bulk is in the file that comes along
};

/// More than any message of ours; a header beyond it is none.
constexpr uint64_t kMostBytes = uint64_t{1} << 30;
/// Memory is taken as bytes come, so much at a time: a header alone is no reason to.
constexpr size_t kReceivedPieceBytes = size_t{1} << 20;

union ControlBuffer {
  cmsghdr alignment;
  std::array<char, CMSG_SPACE(sizeof(int))> bytes;
};

absl::Status SocketError(int error) {
  if (error == EAGAIN || error == EWOULDBLOCK)
    return absl::DeadlineExceededError("the other process does not answer");
  return absl::UnavailableError(absl::StrCat("the other process is gone: ", std::strerror(error)));
}

ssize_t SendHeader(int socket, const Header& header, int file) {
  Header copy = header;
  iovec part{&copy, sizeof(copy)};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  ControlBuffer control{};
  if (file >= 0) {
    message.msg_control = &control;
    message.msg_controllen = sizeof(control);
    cmsghdr* const rights = CMSG_FIRSTHDR(&message);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(rights), &file, sizeof(int));
  }
  return ::sendmsg(socket, &message, MSG_NOSIGNAL);
}

/// Also takes the file that came along, if one did.
ssize_t ReceiveHeader(int socket, Header& header, FileDescriptor& file) {
  iovec part{&header, sizeof(header)};
  ControlBuffer control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = &control;
  message.msg_controllen = sizeof(control);
  const ssize_t received = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC | MSG_WAITALL);
  if (received <= 0) return received;
  const cmsghdr* const rights = CMSG_FIRSTHDR(&message);
  if (rights == nullptr || rights->cmsg_level != SOL_SOCKET || rights->cmsg_type != SCM_RIGHTS)
    return received;
  // The buffer has room for a second file behind the first, which must not stay open.
  for (size_t i = 0; CMSG_LEN((i + 1) * sizeof(int)) <= rights->cmsg_len; ++i) {
    int fd = -1;
    std::memcpy(&fd, CMSG_DATA(rights) + i * sizeof(int), sizeof(int));
    file = FileDescriptor(fd);
  }
  return received;
}

}  // namespace

MessageChannel::MessageChannel(FileDescriptor socket, double timeout_s)
    : socket_(std::move(socket)) {
  if (timeout_s <= 0.0) return;
  const timeval timeout{.tv_sec = static_cast<time_t>(timeout_s) + 1, .tv_usec = 0};
  ::setsockopt(socket_.get(), SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof(timeout));
  ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof(timeout));
}

absl::StatusOr<std::pair<FileDescriptor, FileDescriptor>> MessageChannel::MakePair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return absl::UnavailableError(absl::StrCat("cannot make a socket: ", std::strerror(errno)));
  return std::pair(FileDescriptor(ends[0]), FileDescriptor(ends[1]));
}

absl::Status MessageChannel::SendAll(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return SocketError(errno);
    bytes.remove_prefix(static_cast<size_t>(sent));
  }
  return absl::OkStatus();
}

absl::Status MessageChannel::ReceiveAll(void* bytes, size_t size) {
  auto* next = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t received = ::recv(socket_.get(), next, size, MSG_WAITALL);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) return SocketError(received == 0 ? ECONNRESET : errno);
    next += received;
    size -= static_cast<size_t>(received);
  }
  return absl::OkStatus();
}

absl::StatusOr<std::string> MessageChannel::ReceiveText(size_t size) {
  std::string text;
  while (text.size() < size) {
    const size_t piece = std::min(size - text.size(), kReceivedPieceBytes);
    text.resize(text.size() + piece);
    ORBWEAVE_RETURN_IF_ERROR(ReceiveAll(text.data() + text.size() - piece, piece));
  }
  return text;
}

absl::Status MessageChannel::Send(std::string_view message, const SharedBytes& bulk) {
  const bool has_file = bulk.descriptor() >= 0;
  const std::string_view inlined = has_file ? std::string_view() : bulk.View();
  const Header header{message.size(), inlined.size(), has_file ? uint64_t{1} : uint64_t{0}};
  ssize_t sent = 0;
  do {
    sent = SendHeader(socket_.get(), header, bulk.descriptor());
  } while (sent < 0 && errno == EINTR);
  if (sent < 0) return SocketError(errno);
  const std::string_view rest(reinterpret_cast<const char*>(&header), sizeof(header));
  ORBWEAVE_RETURN_IF_ERROR(SendAll(rest.substr(static_cast<size_t>(sent))));
  ORBWEAVE_RETURN_IF_ERROR(SendAll(message));
  return SendAll(inlined);
}

absl::StatusOr<Frame> MessageChannel::Receive() {
  Header header;
  FileDescriptor file;
  ssize_t received = 0;
  do {
    received = ReceiveHeader(socket_.get(), header, file);
  } while (received < 0 && errno == EINTR);
  if (received <= 0) return SocketError(received == 0 ? ECONNRESET : errno);
  const auto have = static_cast<size_t>(received);
  ORBWEAVE_RETURN_IF_ERROR(
      ReceiveAll(reinterpret_cast<char*>(&header) + have, sizeof(header) - have));
  if (header.message_bytes > kMostBytes || header.bulk_bytes > kMostBytes ||
      (header.has_file != 0) != file.IsOpen()) {
    return absl::DataLossError("the other process sent what is no frame");
  }
  Frame frame;
  ORBWEAVE_ASSIGN_OR_RETURN(frame.message, ReceiveText(header.message_bytes));
  if (file.IsOpen()) {
    ORBWEAVE_ASSIGN_OR_RETURN(frame.bulk, SharedBytes::FromFile(std::move(file)));
  } else if (header.bulk_bytes > 0) {
    ORBWEAVE_ASSIGN_OR_RETURN(std::string bytes, ReceiveText(header.bulk_bytes));
    frame.bulk = SharedBytes::Of(std::move(bytes));
  }
  return frame;
}

}  // namespace orbweave
