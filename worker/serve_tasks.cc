// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/serve_tasks.h"

#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/pipeline/damaged_blob.h"
#include "orbweave/v1/task_process.pb.h"
#include "proto/codec/coordinator_codec.h"
#include "worker/message_channel.h"

namespace orbweave {
namespace {

/// Between two messages of the same kind that tell how a task goes: more would be for nobody.
constexpr double kApart_s = 0.1;

/// The answer to a request for a blob, with its bytes.
struct BlobReply {
  v1::BlobAnswer answer{};
  SharedBytes bulk{};

  [[nodiscard]] absl::Status status() const {
    return {static_cast<absl::StatusCode>(answer.code()), answer.message()};
  }
};

v1::FromTaskProcess EndMessage(const absl::StatusOr<TaskResult>& result) {
  v1::FromTaskProcess message;
  v1::TaskEnd& end = *message.mutable_end();
  end.set_code(static_cast<uint32_t>(result.status().code()));
  end.set_message(std::string(result.status().message()));
  if (const auto blob = BlobToBlame(result.status())) end.set_damaged(ToProto(*blob));
  if (result.ok()) *end.mutable_result() = ToProto(*result);
  return message;
}

/// The main thread runs the tasks; another one reads, so that a wish to stop is heard at once.
class TaskServer final : public BlobAccess {
 public:
  TaskServer(FileDescriptor socket, const StageLookup& stages, const Clock& clock)
      : channel_(std::move(socket)), stages_(stages), clock_(clock) {}

  void Run() {
    const std::jthread reader([this] { ReadUntilClosed(); });
    while (const std::optional<v1::RunTask> task = NextTask()) {
      const v1::FromTaskProcess end = EndMessage(RunOne(*task));
      SetIdle();
      (void)Send(end);  // a worker that is gone is noticed by the reader
    }
  }

  absl::StatusOr<std::string> Get(const Digest& digest) override {
    const BlobReply reply = Ask(digest);
    ORBWEAVE_RETURN_IF_ERROR(reply.status());
    return std::string(reply.bulk.View());
  }

  /// The worker stores the bytes while the task goes on, and takes the task's end for its end only
  /// when they are stored.
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    const Digest digest = DigestOf(bytes);
    v1::FromTaskProcess message;
    message.set_put(ToProto(digest));
    ORBWEAVE_RETURN_IF_ERROR(Send(message, SharedBytes::CopyOf(bytes)));
    return digest;
  }

 private:
  absl::StatusOr<TaskResult> RunOne(const v1::RunTask& task) {
    ORBWEAVE_ASSIGN_OR_RETURN(const TaskSpec spec, FromProto(task.spec()));
    StageContext context;
    {
      const std::lock_guard lock(mutex_);
      context.stop = stop_.get_token();
    }
    context.num_threads = task.num_threads();
    context.seed = task.seed();
    context.report = [this](const Progress& progress) { Report(progress); };
    context.alive = [this] { ShowLife(); };
    reported_s_.reset();
    return RunTask(stages_, spec, *this, context, clock_);
  }

  absl::Status Send(const v1::FromTaskProcess& message, const SharedBytes& bulk = {}) {
    const std::lock_guard lock(send_mutex_);
    return channel_.Send(message.SerializeAsString(), bulk);
  }

  void ShowLife() {
    const double now_s = clock_.NowSeconds();
    double before_s = showed_life_s_;
    if (now_s < before_s + kApart_s || !showed_life_s_.compare_exchange_strong(before_s, now_s))
      return;
    v1::FromTaskProcess message;
    message.mutable_alive();
    (void)Send(message);  // a worker that is gone is noticed by the reader
  }

  void Report(const Progress& progress) {
    {
      const std::lock_guard lock(mutex_);
      const double now_s = clock_.NowSeconds();
      if (reported_s_ && now_s < *reported_s_ + kApart_s) return;
      reported_s_ = now_s;
    }
    v1::FromTaskProcess message;
    message.mutable_progress()->set_done(progress.done);
    message.mutable_progress()->set_total(progress.total);
    message.mutable_progress()->set_unit(progress.unit);
    (void)Send(message);  // a worker that is gone is noticed by the reader
  }

  /// One request at a time.
  BlobReply Ask(const Digest& digest) {
    v1::FromTaskProcess message;
    message.set_get(ToProto(digest));
    const std::lock_guard asking(ask_mutex_);
    (void)Send(message);  // a worker that is gone is noticed by the reader
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return reply_.has_value(); });
    BlobReply reply = *std::move(reply_);
    reply_.reset();
    return reply;
  }

  /// Nothing: the other end is closed.
  std::optional<v1::RunTask> NextTask() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return next_.has_value() || is_closed_; });
    is_busy_ = next_.has_value();
    return std::exchange(next_, std::nullopt);
  }

  void SetIdle() {
    const std::lock_guard lock(mutex_);
    is_busy_ = false;
  }

  void ReadUntilClosed() {
    while (true) {
      absl::StatusOr<Frame> frame = channel_.Receive();
      v1::ToTaskProcess message;
      const bool is_open = frame.ok() && message.ParseFromString(frame->message);
      const std::lock_guard lock(mutex_);
      if (!is_open && is_busy_) std::_Exit(EXIT_FAILURE);  // nobody waits for the task's result
      if (!is_open) is_closed_ = true;
      if (message.has_stop()) stop_.request_stop();
      if (message.has_run()) Begin(message.run());
      if (message.has_blob()) reply_ = BlobReply{message.blob(), std::move(frame->bulk)};
      changed_.notify_all();
      if (!is_open) return;
    }
  }

  void Begin(const v1::RunTask& task) {
    next_ = task;
    stop_ = std::stop_source();
  }

  MessageChannel channel_;
  const StageLookup& stages_;
  const Clock& clock_;
  std::mutex send_mutex_;
  std::mutex ask_mutex_;
  std::atomic<double> showed_life_s_ = 0.0;
  std::mutex mutex_;  ///< of all below
  std::condition_variable changed_;
  bool is_closed_ = false;
  bool is_busy_ = false;
  std::optional<v1::RunTask> next_;
  std::stop_source stop_;
  std::optional<BlobReply> reply_;
  std::optional<double> reported_s_;
};

}  // namespace

void ServeTasks(FileDescriptor socket, const StageLookup& stages, const Clock& clock) {
  TaskServer(std::move(socket), stages, clock).Run();
}

}  // namespace orbweave
