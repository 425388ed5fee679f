// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/worker_loop.h"

#include <algorithm>
#include <cmath>
#include <latch>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/clock.h"
#include "core/base/sleep.h"
#include "core/pipeline/build_version.h"
#include "core/pipeline/is_to_leave.h"
#include "worker/blob_cache.h"
#include "worker/coordinator_contact.h"
#include "worker/held_leases.h"
#include "worker/retry.h"
#include "worker/scratch_tier.h"
#include "worker/shared_store.h"
#include "worker/worker_session.h"

namespace orbweave {
namespace {

/// So that a coordinator tells a worker that comes back from one that was started anew.
uint64_t NameOfProcess() {
  std::random_device device;
  return (uint64_t{device()} << 32 | device()) | 1;
}

LogEvent Describe(const Lease& lease, const std::string& event, const std::string& message = "") {
  return {.event = event,
          .stage = lease.spec.stage,
          .part = lease.spec.part,
          .task = lease.task,
          .epoch = lease.epoch,
          .message = message};
}

/// The coordinator will not have us: waiting does not help.
bool IsRefusal(const absl::Status& status) {
  return absl::IsPermissionDenied(status) || absl::IsUnauthenticated(status);
}

/// What asking for a task again may get over: all but what an answer is to.
bool MayPass(const absl::Status& status) {
  return !absl::IsNotFound(status) && !absl::IsCancelled(status) && !IsRefusal(status);
}

/// A slot has one executor and two lanes: while one's task runs, the other stores and hands in the
/// result before it and takes what the coordinator gives ahead.
constexpr int kLanes = 2;

struct Slot {
  uint32_t number = 0;
  std::unique_ptr<TaskExecutor> executor{};
  std::mutex asking{};         ///< one lane asks for a task at a time
  std::mutex running{};        ///< of the executor
  std::latch leaving{kLanes};  ///< its process dies with the lane that started it
};

class Worker {
 public:
  /// `store`: where results go and all is checked with each session; `blobs`: by which it is read.
  Worker(WorkerApi& api,
         SharedStore& store,
         BlobAccess& blobs,
         const MakeTaskExecutor& make_executor,
         const WorkerOptions& options)
      : api_(api),
        make_executor_(make_executor),
        options_(options),
        contact_(options.term.patience_s, options.term.idle_s, 0.0),
        store_(store),
        session_(
            api,
            store_,
            {.name = options.name,
             .version = std::string(BuildVersion()),
             .slots = options.slots,
             .process = NameOfProcess(),
             .offers = options.offers},
            leases_,
            [this] { return StaysFor_s(); },
            [this](const absl::Status& why) { return Waits(why); }),
        blobs_(blobs, options.cache_bytes, ending_.get_token()) {}

  absl::StatusOr<WorkerEnd> Run(const std::stop_token& stop) {
    const std::stop_callback on_stop(stop, [this] { Drain(); });
    {
      const std::jthread heartbeat([this] { BeatUntilEnd(); });
      const std::jthread term([this] { EndInTime(); });
      std::vector<std::jthread> slots;
      for (uint32_t slot = 0; slot < options_.slots; ++slot) {
        slots.emplace_back([this, slot] { StartLanes(slot); });
      }
      slots.clear();  // joins: the heart beats until the last task is handed in or given back
      beating_.request_stop();
    }
    session_.Leave();
    const std::lock_guard lock(mutex_);
    return end_.value_or(WorkerEnd::kStopped);
  }

 private:
  /// Seconds since its start.
  [[nodiscard]] double Now_s() const { return clock_.NowSeconds() - started_s_; }

  /// Takes no more tasks; what runs has the grace, or the time that is left.
  void Drain() {
    TakeNoMore(WorkerEnd::kStopped);
    const std::lock_guard lock(mutex_);
    if (grace_.joinable()) return;
    grace_ = std::jthread([this] {
      WaitUntilAllIsIn(std::min(options_.grace_s, options_.term.stays_s - Now_s()));
      End(WorkerEnd::kStopped);
    });
  }

  /// Finishes what runs, and leaves. The first reason is kept.
  void TakeNoMore(const absl::StatusOr<WorkerEnd>& end) {
    {
      const std::lock_guard lock(mutex_);
      if (!end_) end_ = end;
    }
    draining_.request_stop();
  }

  /// Gives back what runs, and leaves.
  void End(const absl::StatusOr<WorkerEnd>& end) {
    TakeNoMore(end);
    if (ending_.request_stop()) leases_.StopAll();
  }

  /// What the engine that started it has said of its time.
  void EndInTime() {
    const double gone_s = options_.term.stays_s - options_.grace_s;
    const double alone_s = options_.term.lifetime_s;
    WaitUntilAllIsIn(std::min(gone_s, alone_s));
    if (beating_.stop_requested()) return;
    if (alone_s < gone_s) {
      TakeNoMore(WorkerEnd::kStopped);
      WaitUntilAllIsIn(gone_s - Now_s());
    }
    if (!beating_.stop_requested()) Drain();
  }

  /// Nothing: it does not know of an end.
  std::optional<double> StaysFor_s() const {
    const double stays_s = options_.term.stays_s - Now_s();
    return std::isinf(stays_s) ? std::nullopt : std::optional(std::max(0.0, stays_s));
  }

  void Log(LogEvent event) const {
    if (!options_.log) return;
    event.worker = options_.name;
    options_.log(event);
  }

  /// Whether a coordinator that does not answer is waited for.
  bool Waits(const absl::Status& why) {
    contact_.NotHeard();
    Log({.level = LogLevel::kWarning,
         .event = "coordinator_away",
         .message = std::string(why.message())});
    return !contact_.IsGivenUp(Now_s());
  }

  /// There is no session, nor will there be one; but who is told to end need not have one.
  void EndWithout(const absl::Status& session) {
    if (draining_.stop_requested() && absl::IsCancelled(session)) return;
    const bool is_away = absl::IsUnavailable(session) || absl::IsCancelled(session);
    End(is_away ? GivenUp(session) : session);
  }

  /// The session, or nothing when the work is over.
  std::optional<JoinReply> Session() {
    const absl::StatusOr<JoinReply> reply = session_.Get(draining_.get_token());
    if (reply.ok()) return *reply;
    EndWithout(reply.status());
    return std::nullopt;
  }

  void StartLanes(uint32_t number) {
    Slot slot{.number = number, .executor = make_executor_()};
    std::vector<std::jthread> lanes;
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes.emplace_back([this, &slot] {
        WorkUntilEnd(slot);
        slot.leaving.arrive_and_wait();
      });
    }
  }

  void WorkUntilEnd(Slot& slot) {
    const RetryRule until_told{.stop = draining_.get_token(),
                               .is_passing = MayPass,
                               .goes_on = [this](const absl::Status& why) { return Waits(why); }};
    while (!draining_.stop_requested()) {
      const std::optional<JoinReply> session = Session();
      if (!session) return;
      const absl::StatusOr<std::optional<Lease>> lease =
          Retry(until_told, [&] { return Ask(slot, session->session); });
      if (lease.ok()) {
        if (*lease) Work(**lease, slot);
      } else if (absl::IsNotFound(lease.status())) {
        session_.Forget(session->session);
      } else if (IsToLeave(lease.status())) {
        TakeNoMore(WorkerEnd::kDismissed);
      } else if (IsRefusal(lease.status())) {
        End(lease.status());
      } else if (IsGivenUp(lease.status())) {
        End(GivenUp(lease.status()));
      }
    }
  }

  /// Whether this was said of a coordinator that is waited for no more.
  [[nodiscard]] bool IsGivenUp(const absl::Status& status) const {
    return !status.ok() && MayPass(status) && contact_.IsGivenUp(Now_s());
  }

  absl::Status GivenUp(const absl::Status& why) const {
    return absl::UnavailableError(absl::StrCat(
        "no coordinator answered for ", options_.term.patience_s, " s: ", why.message()));
  }

  /// Nothing when there is none, or the other hand asked until this one need not any more.
  absl::StatusOr<std::optional<Lease>> Ask(Slot& slot, uint64_t session) {
    const std::lock_guard asking(slot.asking);
    if (draining_.stop_requested()) return std::nullopt;
    return api_.LeaseTask(session, slot.number, options_.poll_s, draining_.get_token());
  }

  /// The slot's next task begins while what this one left is still on its way to the store.
  absl::StatusOr<TaskResult> Run(Slot& slot, const TaskSpec& spec, const StageContext& context) {
    TaskBlobs blobs(blobs_);
    absl::StatusOr<TaskResult> result = RunAlone(slot, spec, blobs, context);
    const absl::Status stored = blobs.Settle();
    if (result.ok()) ORBWEAVE_RETURN_IF_ERROR(stored);
    return result;
  }

  static absl::StatusOr<TaskResult> RunAlone(Slot& slot,
                                             const TaskSpec& spec,
                                             TaskBlobs& blobs,
                                             const StageContext& context) {
    const std::lock_guard running(slot.running);
    return slot.executor->Run(spec, blobs, context);
  }

  void Work(const Lease& lease, Slot& slot) {
    StageContext context;
    context.stop = leases_.Add(lease);
    context.num_threads = options_.threads_per_task;
    context.seed = lease.task.ToSeed();
    context.report = [this, epoch = lease.epoch](const Progress& progress) {
      leases_.Report(epoch, progress);
    };
    if (ending_.stop_requested())
      leases_.StopAll();  // the end may have come between leasing and adding
    contact_.Worked(Now_s());
    Log(Describe(lease, "task_leased"));
    const absl::StatusOr<TaskResult> result = Run(slot, lease.spec, context);
    const absl::Status handed_in = result.ok() ? HandIn(lease, *result) : result.status();
    if (!handed_in.ok()) {
      const bool given_up = context.stop.stop_requested();
      GiveBack(lease, given_up ? absl::CancelledError("the worker gave it up") : handed_in);
    }
    leases_.Remove(lease.epoch);
    contact_.Worked(Now_s());
  }

  /// Calls `call(session)` through times without a coordinator; joins again when it was restarted.
  template <typename Call>
  absl::Status InSession(Call&& call) {
    while (true) {
      const absl::StatusOr<JoinReply> session = session_.Get(ending_.get_token());
      if (!session.ok()) return session.status();
      const absl::Status status =
          Retry({.stop = ending_.get_token()}, [&] { return call(session->session); });
      if (!absl::IsNotFound(status)) return status;
      session_.Forget(session->session);
    }
  }

  /// Hands a result in. Blobs that the coordinator does not see yet are waited for; in the end it
  /// is the store that failed, not the task.
  absl::Status HandIn(const Lease& lease, const TaskResult& result) {
    constexpr double kLongestLag_s = 10.0;  // NFS keeps what it knows of a folder for some seconds
    const double until_s = Now_s() + kLongestLag_s;
    const RetryRule until_seen{
        .stop = ending_.get_token(),
        .is_passing = [](const absl::Status& status) { return absl::IsAborted(status); },
        .goes_on = [&](const absl::Status&) { return Now_s() < until_s; }};
    const absl::Status status = Retry(until_seen, [&] {
      return InSession([&](uint64_t session) { return api_.CompleteTask(session, lease, result); });
    });
    if (absl::IsAborted(status)) return absl::UnavailableError(status.message());
    if (status.ok()) Log(Describe(lease, "task_done", absl::StrCat("wall_s=", result.cost.wall_s)));
    return status;
  }

  /// Tells the coordinator why there is no result. A lease that is no longer ours is not its
  /// business.
  void GiveBack(const Lease& lease, const absl::Status& error) {
    Log(Describe(lease, "task_not_done", error.ToString()));
    (void)InSession([&](uint64_t session) { return api_.FailTask(session, lease, error); });
  }

  void BeatUntilEnd() {
    while (!beating_.stop_requested()) {
      WaitUntilAllIsIn(Beat());
    }
  }

  void WaitUntilAllIsIn(double longest_s) { SleepUnlessStopped(longest_s, beating_.get_token()); }

  /// One heartbeat; returns the seconds until the next.
  double Beat() {
    constexpr double kSoon = 0.5;
    const bool holds_nothing = leases_.List().empty();
    if (draining_.stop_requested() && holds_nothing) return kSoon;
    const std::stop_source& over = holds_nothing ? draining_ : ending_;
    const absl::StatusOr<JoinReply> session = session_.Get(over.get_token());
    if (!session.ok()) {
      EndWithout(session.status());
      return kSoon;
    }
    const absl::StatusOr<HeartbeatReply> reply = api_.Heartbeat(session->session, leases_.List());
    if (absl::IsNotFound(reply.status())) session_.Forget(session->session);
    if (IsRefusal(reply.status())) End(reply.status());
    if (IsGivenUp(reply.status())) End(GivenUp(reply.status()));
    if (!reply.ok()) return kSoon;
    contact_.Heard(!leases_.List().empty(), Now_s());
    for (const Digest& task : reply->cancelled) leases_.StopTask(task);
    if (reply->shutdown) End(WorkerEnd::kDismissed);
    const double until_idle_s = contact_.UntilIdle(Now_s());
    if (until_idle_s <= 0.0) TakeNoMore(WorkerEnd::kIdle);
    return std::min(session->heartbeat_s, std::max(kSoon, until_idle_s));
  }

  WorkerApi& api_;
  const MakeTaskExecutor& make_executor_;
  const WorkerOptions& options_;
  SteadyClock clock_;
  const double started_s_ = clock_.NowSeconds();
  CoordinatorContact contact_;
  std::mutex mutex_;
  std::optional<absl::StatusOr<WorkerEnd>> end_;
  std::stop_source draining_;  ///< take no more
  std::stop_source ending_;    ///< give back what runs
  std::stop_source beating_;   ///< all is handed in
  HeldLeases leases_;
  SharedStore& store_;
  WorkerSession session_;
  BlobCache blobs_;
  std::jthread grace_;  ///< last: ends before what it uses
};

}  // namespace

absl::StatusOr<WorkerEnd> RunWorker(WorkerApi& coordinator,
                                    BlobAccess& blobs,
                                    const MakeTaskExecutor& make_executor,
                                    const WorkerOptions& options,
                                    const std::stop_token& stop) {
  SharedStore store(blobs, options.blob_folder);
  if (options.scratch_folder.empty())
    return Worker(coordinator, store, store, make_executor, options).Run(stop);
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto scratch, ScratchTier::Make(store, options.scratch_folder, options.scratch_bytes));
  return Worker(coordinator, store, *scratch, make_executor, options).Run(stop);
}

}  // namespace orbweave
