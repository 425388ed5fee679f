// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/message_channel.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <thread>

namespace orbweave {
namespace {

struct Connection {
  MessageChannel left;
  MessageChannel right;
};

Connection Connect(double timeout_s = 0.0) {
  auto ends = MessageChannel::MakePair();
  return {MessageChannel(std::move(ends->first)),
          MessageChannel(std::move(ends->second), timeout_s)};
}

TEST(MessageChannel, CarriesFramesOfAllSizesInOrder) {
  Connection connection = Connect();
  const size_t least = SharedBytes::kLeastFileBytes;
  const std::vector<size_t> sizes = {0, 1, 1000, least - 1, least, size_t{5} << 20};
  const std::jthread sender([&] {
    for (const size_t message : sizes) {
      for (const size_t bulk : sizes) {
        const SharedBytes bytes = SharedBytes::CopyOf(std::string(bulk, 'b'));
        EXPECT_TRUE(connection.left.Send(std::string(message, 'm'), bytes).ok());
      }
    }
  });
  for (const size_t message : sizes) {
    for (const size_t bulk : sizes) {
      const auto frame = connection.right.Receive();
      ASSERT_TRUE(frame.ok()) << frame.status();
      EXPECT_EQ(frame->message, std::string(message, 'm'));
      EXPECT_EQ(frame->bulk.View(), std::string(bulk, 'b'));
      EXPECT_EQ(frame->bulk.descriptor() >= 0, bulk >= least);
    }
  }
}

TEST(MessageChannel, SaysWhenTheOtherEndIsClosed) {
  Connection connection = Connect();
  { const MessageChannel closed = std::move(connection.left); }
  EXPECT_TRUE(absl::IsUnavailable(connection.right.Receive().status()));
  EXPECT_TRUE(absl::IsUnavailable(connection.right.Send("text")));
}

TEST(MessageChannel, DoesNotWaitForEverForTheRestOfAFrame) {
  Connection connection = Connect(0.1);
  ASSERT_EQ(::send(connection.left.descriptor(), "begin", 5, 0), 5);
  EXPECT_TRUE(absl::IsDeadlineExceeded(connection.right.Receive().status()));
}

TEST(MessageChannel, RefusesWhatIsNoFrame) {
  Connection connection = Connect();
  const std::string noise(100, '\xff');
  ASSERT_EQ(::send(connection.left.descriptor(), noise.data(), noise.size(), 0), 100);
  EXPECT_TRUE(absl::IsDataLoss(connection.right.Receive().status()));
}

/// Sends a header that promises nothing, and `files` along with it.
void SendWithFiles(int socket, const std::array<int, 2>& files) {
  std::array<char, 24> header{};
  iovec part{header.data(), header.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(files))> control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  cmsghdr* const rights = CMSG_FIRSTHDR(&message);
  rights->cmsg_level = SOL_SOCKET;
  rights->cmsg_type = SCM_RIGHTS;
  rights->cmsg_len = CMSG_LEN(sizeof(files));
  std::memcpy(CMSG_DATA(rights), files.data(), sizeof(files));
  ASSERT_EQ(::sendmsg(socket, &message, 0), 24);
}

TEST(MessageChannel, KeepsNoFileOpenThatNobodyAskedFor) {
  const auto open_files = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
  };
  Connection connection = Connect();
  const FileDescriptor file(::memfd_create("unasked", MFD_CLOEXEC));
  const auto before = open_files();
  SendWithFiles(connection.left.descriptor(), {file.get(), file.get()});
  EXPECT_TRUE(absl::IsDataLoss(connection.right.Receive().status()));
  EXPECT_EQ(open_files(), before);
}

TEST(SharedBytes, RefusesAFileThatMayStillChange) {
  FileDescriptor file(::memfd_create("open", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  ASSERT_EQ(::ftruncate(file.get(), 4096), 0);
  EXPECT_TRUE(absl::IsInvalidArgument(SharedBytes::FromFile(std::move(file)).status()));
}

TEST(SharedBytes, AreGatheredPieceByPiece) {
  for (const size_t size : {size_t{0}, size_t{7}, SharedBytes::kLeastFileBytes + 5}) {
    const std::string bytes(size, 'a');
    SharedBytesBuilder builder;
    for (size_t begin = 0; begin < size; begin += 1000)
      ASSERT_TRUE(builder.Append(std::string_view(bytes).substr(begin, 1000)).ok());
    const absl::StatusOr<SharedBytes> gathered = builder.Finish();
    ASSERT_TRUE(gathered.ok()) << gathered.status();
    EXPECT_TRUE(gathered->View() == bytes);
    EXPECT_EQ(gathered->descriptor() >= 0, size >= SharedBytes::kLeastFileBytes);
  }
}

TEST(SharedBytes, NobodyCanChangeThem) {
  const SharedBytes bytes = SharedBytes::CopyOf(std::string(SharedBytes::kLeastFileBytes, 'a'));
  ASSERT_GE(bytes.descriptor(), 0);
  EXPECT_LT(::pwrite(bytes.descriptor(), "b", 1, 0), 0);
  EXPECT_NE(::ftruncate(bytes.descriptor(), 0), 0);
  EXPECT_EQ(bytes.View().front(), 'a');
}

}  // namespace
}  // namespace orbweave
