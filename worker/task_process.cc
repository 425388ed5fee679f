// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_process.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <array>
#include <cmath>
#include <stop_token>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/pipeline/damaged_blob.h"
#include "proto/codec/coordinator_codec.h"

namespace orbweave {
namespace {

/// A wish to stop as something that poll can wait for.
class StopEvent {
 public:
  explicit StopEvent(const std::stop_token& stop)
      : event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
        on_stop_(stop, [this] { (void)::eventfd_write(event_.get(), 1); }) {}
  [[nodiscard]] int descriptor() const { return event_.get(); }

 private:
  FileDescriptor event_;
  std::stop_callback<std::function<void()>> on_stop_;
};

/// Whether there is something to read before `wait_s` is over or `stop` (negative: nothing)
/// happens.
bool WaitForInput(int input, int stop, double wait_s) {
  std::array<pollfd, 2> files{{{input, POLLIN, 0}, {stop, POLLIN, 0}}};
  const int ready = ::poll(files.data(), files.size(), static_cast<int>(std::ceil(1000 * wait_s)));
  return ready > 0 && files[0].revents != 0;
}

v1::ToTaskProcess RunMessage(const TaskSpec& spec, const StageContext& context) {
  v1::ToTaskProcess message;
  *message.mutable_run()->mutable_spec() = ToProto(spec);
  message.mutable_run()->set_num_threads(context.num_threads);
  message.mutable_run()->set_seed(context.seed);
  return message;
}

v1::ToTaskProcess StopMessage() {
  v1::ToTaskProcess message;
  message.mutable_stop();
  return message;
}

v1::ToTaskProcess BlobMessage(const absl::Status& status) {
  v1::ToTaskProcess message;
  message.mutable_blob()->set_code(static_cast<uint32_t>(status.code()));
  message.mutable_blob()->set_message(std::string(status.message()));
  return message;
}

absl::StatusOr<TaskResult> ResultOf(const v1::TaskEnd& end) {
  if (end.code() == 0) return FromProto(end.result());
  const absl::Status error(static_cast<absl::StatusCode>(end.code()), end.message());
  if (end.damaged().empty()) return error;
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest blob, DigestFromProto(end.damaged()));
  return BlameBlob(error, blob);
}

}  // namespace

absl::Status TaskProcess::EnsureStarted() {
  if (channel_ && !process_.PollEnd()) return absl::OkStatus();
  EndProcess();
  ORBWEAVE_ASSIGN_OR_RETURN(auto ends, MessageChannel::MakePair());
  std::vector<std::string> arguments = {"orbweave", "exec-tasks"};
  if (limits_.memory_bytes > 0) {
    arguments.insert(arguments.end(), {"--memory", absl::StrCat(limits_.memory_bytes)});
  }
  ORBWEAVE_ASSIGN_OR_RETURN(process_,
                            ChildProcess::SpawnSelf(arguments, {.channel = ends.second.get()}));
  channel_.emplace(std::move(ends.first), limits_.stall_s);
  return absl::OkStatus();
}

std::string TaskProcess::EndProcess() {
  channel_.reset();
  return process_.Kill();
}

absl::Status TaskProcess::Send(const v1::ToTaskProcess& message, const SharedBytes& bulk) {
  return channel_->Send(message.SerializeAsString(), bulk);
}

absl::StatusOr<TaskResult> TaskProcess::Run(const TaskSpec& spec,
                                            TaskBlobs& blobs,
                                            const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(EnsureStarted());
  const absl::StatusOr<v1::TaskEnd> end = Attend(spec, blobs, context);
  if (end.ok()) return ResultOf(*end);
  const std::string death = EndProcess();
  if (!absl::IsUnavailable(end.status())) return end.status();
  return absl::AbortedError("the process that ran the task ended with " + death);
}

absl::StatusOr<v1::TaskEnd> TaskProcess::Attend(const TaskSpec& spec,
                                                TaskBlobs& blobs,
                                                const StageContext& context) {
  const StopEvent stop(context.stop);
  TaskWatch watch(limits_, clock_.NowSeconds(), process_.CpuSeconds());
  std::optional<double> kill_at_s;
  ORBWEAVE_RETURN_IF_ERROR(Send(RunMessage(spec, context)));
  while (true) {
    const int stop_event = kill_at_s ? -1 : stop.descriptor();
    if (WaitForInput(channel_->descriptor(), stop_event, watch.Wait())) {
      ORBWEAVE_ASSIGN_OR_RETURN(std::optional<v1::TaskEnd> end, ReceiveOne(blobs, context));
      if (end) return *std::move(end);
      watch.SawSign(clock_.NowSeconds(), process_.CpuSeconds());
    }
    const double now_s = clock_.NowSeconds();
    if (context.stop.stop_requested() && !kill_at_s) {
      ORBWEAVE_RETURN_IF_ERROR(Send(StopMessage()));
      kill_at_s = now_s + limits_.stop_grace_s;
    }
    if (kill_at_s && now_s >= *kill_at_s)
      return absl::CancelledError("its process was killed: it did not stop when told to");
    if (const auto reason = watch.Look(now_s, process_.CpuSeconds()))
      return absl::DeadlineExceededError("its process was killed: " + *reason);
  }
}

absl::StatusOr<std::optional<v1::TaskEnd>> TaskProcess::ReceiveOne(TaskBlobs& blobs,
                                                                   const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(Frame frame, channel_->Receive());
  v1::FromTaskProcess message;
  if (!message.ParseFromString(frame.message))
    return absl::InternalError("the process that ran the task sent what is no message");
  using Body = v1::FromTaskProcess::BodyCase;
  switch (message.body_case()) {
    case Body::kAlive:
      return std::nullopt;
    case Body::kProgress: {
      const v1::TaskProgress& progress = message.progress();
      context.Report(progress.done(), progress.total(), progress.unit().c_str());
      return std::nullopt;
    }
    case Body::kGet:
      ORBWEAVE_RETURN_IF_ERROR(AnswerGet(message.get(), blobs));
      return std::nullopt;
    case Body::kPut: {
      ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, DigestFromProto(message.put()));
      blobs.Put(digest, std::move(frame.bulk));
      return std::nullopt;
    }
    case Body::kEnd:
      return std::move(*message.mutable_end());
    case Body::BODY_NOT_SET:
      break;
  }
  return absl::InternalError("the process that ran the task sent an empty message");
}

absl::Status TaskProcess::AnswerGet(const std::string& digest, TaskBlobs& blobs) {
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest name, DigestFromProto(digest));
  const absl::StatusOr<SharedBytes> bytes = blobs.Get(name);
  return Send(BlobMessage(bytes.status()), bytes.ok() ? *bytes : SharedBytes());
}

}  // namespace orbweave
