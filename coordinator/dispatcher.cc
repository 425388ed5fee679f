// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/dispatcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

bool EveryWorkerMeets(const StageNeeds& needs) {
  return needs.memory_bytes == 0 && needs.threads <= 1 && needs.gpus == 0;
}

uint64_t FirstOfGeneration(uint64_t generation) { return generation << 32; }

}  // namespace

Dispatcher::Dispatcher(DispatcherOptions options, uint64_t generation)
    : options_(std::move(options)),
      roster_(options_.lease_s),
      last_epoch_(FirstOfGeneration(generation)),
      last_session_(FirstOfGeneration(generation)) {}

Job& Dispatcher::BeginJob(const JobSpec& spec, JobPlan plan, uint64_t number, double now_s) {
  VoidLeases(spec.Id(), "the job began anew");
  Job& job = jobs_.Begin(spec, std::move(plan), number, options_.retry, now_s);
  options_.changed();
  return job;
}

void Dispatcher::CancelJob(const Digest& id, double now_s) {
  jobs_.At(id).machine->JobIsCancelled(now_s);
  if (!jobs_.At(id).IsRunning()) VoidLeases(id, "the job was cancelled");
}

void Dispatcher::ForgetJob(const Digest& id) {
  VoidLeases(id, "the job was forgotten");
  jobs_.Forget(id);
}

uint64_t Dispatcher::Join(const WorkerInfo& worker, double now_s) {
  const uint64_t session = ++last_session_;
  roster_.Join(worker, session, now_s);
  roster_.ForgetGone(now_s);
  EndAllLost(book_.Adopt(worker.name, worker.held, session, now_s + options_.lease_s),
             absl::StrCat("worker ", worker.name, " started anew"),
             now_s);
  Log({.event = "worker_joined",
       .worker = worker.name,
       .message = absl::StrCat("slots=", worker.slots, " leases=", worker.held.size())});
  return session;
}

void Dispatcher::Leave(uint64_t session, double now_s) {
  for (const LeaseEntry& entry : book_.TakeSession(session)) {
    EndAttempt(entry, absl::CancelledError("its worker left"), now_s);
  }
  if (const std::string name = roster_.NameOf(session); !name.empty())
    Log({.event = "worker_left", .worker = name});
  roster_.End(session);
}

void Dispatcher::WorkerDied(std::string_view name, double now_s) {
  const std::optional<uint64_t> session = roster_.SessionOf(name);
  if (!session) return;
  Log({.level = LogLevel::kWarning, .event = "worker_died", .worker = std::string(name)});
  EndAllLost(book_.TakeSession(*session),
             absl::StrCat("the process of worker ", std::string(name), " ended"),
             now_s);
  roster_.End(*session);
}

std::vector<WorkerStatus> Dispatcher::WorkerStatuses(double now_s) const {
  std::vector<WorkerStatus> workers = roster_.Status(now_s);
  const std::map<std::string, uint32_t> busy = book_.BusySlots();
  for (WorkerStatus& worker : workers) {
    const auto it = busy.find(worker.name);
    if (it != busy.end()) worker.tasks_running = it->second;
  }
  return workers;
}

bool Dispatcher::MayHaveWork() const {
  return std::ranges::any_of(jobs_.order(), [this](const auto& item) {
    return jobs_.At(item.second).machine->MayHaveWork();
  });
}

bool Dispatcher::MayHaveWork(double now_s) const {
  return std::ranges::any_of(jobs_.order(), [&](const auto& item) {
    return jobs_.At(item.second).machine->MayHaveWork(now_s);
  });
}

size_t Dispatcher::CountAt(uint64_t session, uint32_t slot) const {
  return book_.CountAt({roster_.NameOf(session), slot});
}

std::optional<Dispatcher::JobTask> Dispatcher::NextTask(const WorkerSlot& at,
                                                        const std::vector<std::string>& serving,
                                                        double now_s) {
  const size_t held = book_.CountAt(at);
  if (held > 1 || !std::ranges::binary_search(serving, at.worker)) return std::nullopt;
  const bool ahead = held == 1;
  const StageNeeds taken = TakenBeside(at);
  for (const auto& [number, id] : jobs_.order()) {
    const JobMachine& machine = *jobs_.At(id).machine;
    const StageRule* stage = machine.StageToGiveOut();
    if (stage == nullptr || !HasTime(at, machine, now_s)) continue;
    std::vector<std::string> those_able;
    const std::vector<std::string>& able = EveryWorkerMeets(stage->needs)
                                               ? serving
                                               : (those_able = roster_.Able(serving, stage->needs));
    if (!std::ranges::binary_search(able, at.worker)) continue;
    if (roster_.HasRoom(at.worker, taken, stage->needs)) {
      const auto ref = machine.NextReady(at, able, now_s, ahead);
      if (ref) return JobTask{id, *ref};
    } else if (!book_.Holds(at.worker, id)) {
      return std::nullopt;  // or later jobs' small tasks would never leave room for this one's
    }
  }
  if (ahead) return std::nullopt;
  const uint32_t slots = roster_.Slots(now_s);
  for (const auto& [number, id] : jobs_.order()) {
    const JobMachine& machine = *jobs_.At(id).machine;
    const auto ref = machine.NextStraggler(at.worker, slots, now_s);
    const bool fits = ref && roster_.HasRoom(at.worker, taken, machine.Needs(*ref));
    if (fits && HasTime(at, machine, now_s)) return JobTask{id, *ref};
  }
  return std::nullopt;
}

bool Dispatcher::HasTime(const WorkerSlot& at, const JobMachine& machine, double now_s) const {
  const double stays_s = roster_.StaysFor(at.worker, now_s);
  return std::isinf(stays_s) || machine.UsualTime_s() <= stays_s;
}

StageNeeds Dispatcher::TakenBeside(const WorkerSlot& at) const {
  StageNeeds taken{.threads = 0};
  for (const LeaseEntry* entry : book_.RunningBeside(at)) {
    // Of a lease whose task has no place in its job yet nobody knows what it takes.
    const StageNeeds needs =
        entry->ref ? jobs_.At(entry->job).machine->Needs(*entry->ref) : StageNeeds{};
    taken.memory_bytes += needs.memory_bytes;
    taken.threads += needs.threads;
    taken.gpus += needs.gpus;
  }
  return taken;
}

std::string Dispatcher::UnmetOf(const Job& job, double now_s) const {
  const StageRule* stage = job.machine->StageToGiveOut();
  if (stage == nullptr) return {};
  const std::string missing = roster_.Missing(stage->needs, now_s);
  if (!missing.empty())
    return absl::StrCat("a task of stage ", stage->stage, " asks for ", missing);
  if (job.machine->UsualTime_s() <= roster_.LongestStay(now_s)) return {};
  return absl::StrCat("a task of stage ",
                      stage->stage,
                      " takes ",
                      std::ceil(job.machine->UsualTime_s()),
                      " s, longer than any worker stays");
}

std::optional<Grant> Dispatcher::GrantNext(uint64_t session,
                                           uint32_t slot,
                                           const std::vector<std::string>& serving,
                                           double now_s) {
  const std::string worker = roster_.NameOf(session);
  const std::optional<JobTask> next = NextTask({worker, slot}, serving, now_s);
  if (!next) return std::nullopt;
  const auto& [job, ref] = *next;
  JobMachine& machine = *jobs_.At(job).machine;
  const Lease lease{machine.TaskId(ref), ++last_epoch_, machine.Spec(ref), slot};
  machine.TaskLeased(ref, {lease.epoch, worker, slot}, now_s);
  const LeaseEntry entry{.epoch = lease.epoch,
                         .task = lease.task,
                         .job = job,
                         .ref = ref,
                         .worker = worker,
                         .slot = slot,
                         .session = session,
                         .until_s = kNoEnd};
  book_.Grant(entry);
  starting_.insert(entry.epoch);
  Log(Describe(entry, "task_leased"));
  return Grant{lease, {lease.epoch, lease.task, job, lease.spec.stage, ref.part, worker, slot}};
}

bool Dispatcher::Begin(uint64_t session, const Lease& lease, double now_s) {
  starting_.erase(lease.epoch);
  if (book_.Renew(lease.epoch, lease.task, session, now_s + options_.lease_s) != nullptr)
    return true;
  options_.changed();  // its end may be written down now
  return false;
}

bool Dispatcher::HasLooseEnds() const {
  return roster_.HasBlames() || !spoilt_.empty() ||
         std::ranges::any_of(
             ends_, [this](const AttemptEnd& end) { return !starting_.contains(end.epoch); });
}

LooseEnds Dispatcher::TakeLooseEnds() {
  const auto later = std::ranges::stable_partition(
      ends_, [this](const AttemptEnd& end) { return !starting_.contains(end.epoch); });
  std::vector<AttemptEnd> kept(later.begin(), later.end());
  ends_.erase(later.begin(), later.end());
  return {std::exchange(ends_, std::move(kept)), roster_.TakeBlames(), std::exchange(spoilt_, {})};
}

void Dispatcher::Await(const Attempt& attempt, double now_s) {
  book_.Grant({.epoch = attempt.epoch,
               .task = attempt.task,
               .job = attempt.job,
               .worker = attempt.worker,
               .slot = attempt.slot,
               .until_s = now_s + options_.lease_s});
}

absl::StatusOr<HeartbeatReply> Dispatcher::Heartbeat(uint64_t session,
                                                     const std::vector<LeaseProgress>& leases,
                                                     double now_s) {
  ExpireLeases(now_s);
  ORBWEAVE_RETURN_IF_ERROR(roster_.Hear(session, now_s));
  HeartbeatReply reply;
  for (const LeaseProgress& held : leases) {
    const LeaseEntry* entry = book_.Renew(held.epoch, held.task, session, now_s + options_.lease_s);
    if (entry == nullptr) {
      reply.cancelled.push_back(held.task);
    } else if (entry->ref) {
      jobs_.At(entry->job).machine->TaskProgressed({*entry->ref, entry->epoch}, held.progress);
    }
  }
  return reply;
}

absl::Status Dispatcher::Hold(uint64_t session, const Lease& lease, double now_s) {
  ExpireLeases(now_s);
  if (book_.Renew(lease.epoch, lease.task, session, kNoEnd) != nullptr) return absl::OkStatus();
  return StaleLease(lease.epoch, lease.task);
}

void Dispatcher::LetGo(uint64_t session, const Lease& lease, double now_s) {
  book_.Renew(lease.epoch, lease.task, session, now_s + options_.lease_s);
}

absl::Status Dispatcher::TaskDone(uint64_t session,
                                  const Lease& lease,
                                  const TaskResult& result,
                                  double now_s) {
  const absl::StatusOr<LeaseEntry> entry = book_.Take(lease.epoch, lease.task, session);
  if (!entry.ok()) return jobs_.WasDoneBy(lease) ? absl::OkStatus() : entry.status();
  Log(Describe(*entry, "task_done"));
  if (entry->ref) {
    for (const LeaseEntry& other : book_.TakeTask(entry->job, *entry->ref))
      EndVoid(other, "another attempt was first");
    JobMachine& machine = *jobs_.At(entry->job).machine;
    machine.TaskDone({*entry->ref, entry->epoch}, result, now_s);
    CountDone(session, *entry, result);
  } else {
    ++early_results_;
    roster_.CountTask(session, {});
  }
  options_.changed();
  return absl::OkStatus();
}

void Dispatcher::CountDone(uint64_t session, const LeaseEntry& entry, const TaskResult& result) {
  const Job& job = jobs_.At(entry.job);
  // Whoever left the same bytes that others could not read is not to blame for them.
  if (job.damage.IsIn(result)) return roster_.CountTask(session, {});
  roster_.CountTask(session, job.machine->FailedOn(*entry.ref));
  for (const FailedAttempt& damaged : job.damage.results) {
    if (damaged.task == entry.task && damaged.worker != entry.worker)
      roster_.CountDamage(damaged.worker);
  }
}

absl::Status Dispatcher::TaskFailed(uint64_t session,
                                    const Lease& lease,
                                    const absl::Status& error,
                                    double now_s) {
  ExpireLeases(now_s);
  ORBWEAVE_ASSIGN_OR_RETURN(const LeaseEntry entry, book_.Take(lease.epoch, lease.task, session));
  EndAttempt(entry, error, now_s);
  return absl::OkStatus();
}

void Dispatcher::StageBegins(const Digest& id, PreparedStage prepared, double now_s) {
  const Job& job = jobs_.At(id);
  const bool is_found =
      std::ranges::all_of(prepared.found, [](const auto& result) { return result.has_value(); });
  if (job.had_ended && !is_found) {
    return JobFails(id,
                    "it had ended, but its results are those of another build, or gone; submit it "
                    "again to have it computed",
                    now_s);
  }
  JobMachine& machine = *job.machine;
  machine.StageBegins(std::move(prepared.tasks), std::move(prepared.found), now_s);
  if (machine.state() == JobState::kFailed) VoidLeases(id, "the job failed");
  for (LeaseEntry* entry : book_.AwaitingPlace(id)) {
    const std::optional<TaskRef> ref = machine.FindReady(entry->task);
    if (!ref) continue;
    entry->ref = ref;
    machine.TaskLeased(*ref, {entry->epoch, entry->worker, entry->slot}, now_s);
  }
  options_.changed();
}

void Dispatcher::JobFails(const Digest& id, const std::string& error, double now_s) {
  jobs_.At(id).machine->JobFails(error, now_s);
  VoidLeases(id, "the job failed");
  options_.changed();
}

void Dispatcher::Log(const LogEvent& event) const {
  if (options_.log) options_.log(event);
}

LogEvent Dispatcher::Describe(const LeaseEntry& entry, const std::string& event) {
  LogEvent described{.event = event,
                     .job = entry.job,
                     .task = entry.task,
                     .worker = entry.worker,
                     .slot = entry.slot,
                     .epoch = entry.epoch};
  if (!entry.ref) return described;
  described.stage = jobs_.At(entry.job).machine->Spec(*entry.ref).stage;
  described.run = entry.ref->run;
  described.part = entry.ref->part;
  return described;
}

}  // namespace orbweave
