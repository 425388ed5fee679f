// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/coordinator.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/durable_file.h"
#include "core/pipeline/build_version.h"

namespace orbweave {
namespace {

/// Waiting calls look at the clock this often: leases that ended and retries whose time has come.
constexpr std::chrono::milliseconds kLook{100};
/// How often a job starts over because a blob it had made is gone.
constexpr uint32_t kMaxReruns = 3;

uint64_t FirstOfGeneration(uint64_t generation) { return generation << 32; }

absl::Status NoSuchJob(const Digest& job) {
  return absl::NotFoundError(absl::StrCat("there is no job ", job.ToShortHex()));
}

}  // namespace

absl::StatusOr<std::unique_ptr<Coordinator>> Coordinator::Open(const CoordinatorOptions& options,
                                                               const Clock& clock) {
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(options.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(StateLock lock, StateLock::Acquire(options.state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(BlobStore blobs, BlobStore::Open(options.state_dir + "/blobs"));
  ORBWEAVE_ASSIGN_OR_RETURN(Journal journal, Journal::Open(options.state_dir));
  std::unique_ptr<Coordinator> coordinator(
      new Coordinator(options, clock, std::move(lock), std::move(blobs), std::move(journal)));
  ORBWEAVE_RETURN_IF_ERROR(coordinator->ResumeJobs());
  coordinator->planner_ = std::jthread(
      [raw = coordinator.get()](std::stop_token stop) { raw->RunPlanner(std::move(stop)); });
  return coordinator;
}

Coordinator::Coordinator(const CoordinatorOptions& options,
                         const Clock& clock,
                         StateLock lock,
                         BlobStore blobs,
                         Journal journal)
    : options_(options),
      clock_(clock),
      lock_(std::move(lock)),
      blobs_(std::move(blobs)),
      journal_(std::move(journal)),
      roster_(options.lease_s),
      last_epoch_(FirstOfGeneration(journal_.generation())),
      last_session_(FirstOfGeneration(journal_.generation())) {}

Coordinator::~Coordinator() { BeginShutdown(); }

absl::Status Coordinator::ResumeJobs() {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JobEntry> entries, journal_.LoadJobs());
  const std::lock_guard lock(mutex_);
  for (const JobEntry& entry : entries) {
    absl::StatusOr<JobPlan> plan = options_.find_plan(entry.spec.kind);
    if (!plan.ok()) continue;  // of a build that knew more kinds
    const Digest id = entry.spec.Id();
    Job& job = jobs_[id];
    job.number = entry.number;
    job.verify = entry.state == JobState::kRunning;
    order_[job.number] = id;
    StartRun(job, entry.spec, *std::move(plan));
    const double now_s = clock_.NowSeconds();
    if (entry.state == JobState::kFailed) job.machine->JobFails(entry.error, now_s);
    if (entry.state == JobState::kCancelled) job.machine->JobIsCancelled(now_s);
    job.saved = entry.state != JobState::kRunning;
  }
  return absl::OkStatus();
}

absl::StatusOr<std::string> Coordinator::Get(const Digest& digest) { return blobs_.Get(digest); }

absl::StatusOr<Digest> Coordinator::Put(std::string_view bytes) { return blobs_.Put(bytes); }

absl::StatusOr<std::vector<bool>> Coordinator::StatBlobs(const std::vector<Digest>& digests) {
  std::vector<bool> stored;
  for (const Digest& digest : digests) stored.push_back(blobs_.Has(digest));
  return stored;
}

absl::Status Coordinator::LinkFile(const Digest& digest, const std::string& path) {
  return blobs_.LinkFile(digest, path);
}

absl::StatusOr<JoinReply> Coordinator::Join(const WorkerInfo& worker) {
  if (worker.version != BuildVersion()) {
    return absl::FailedPreconditionError(absl::StrCat("worker ",
                                                      worker.name,
                                                      " is orbweave ",
                                                      worker.version,
                                                      ", the coordinator is ",
                                                      std::string(BuildVersion()),
                                                      ": install the same version on both"));
  }
  const std::lock_guard lock(mutex_);
  const uint64_t session = ++last_session_;
  const std::optional<uint64_t> replaced = roster_.Join(worker, session, clock_.NowSeconds());
  if (replaced)
    EndAttempts(book_.TakeSession(*replaced),
                absl::StrCat("worker ", worker.name, " started anew"));
  Log(absl::StrCat("worker joined worker=", worker.name, " slots=", worker.slots));
  return JoinReply{
      .session = session, .lease_s = options_.lease_s, .heartbeat_s = options_.lease_s / 10.0};
}

absl::Status Coordinator::Leave(uint64_t session) {
  const std::lock_guard lock(mutex_);
  for (const LeaseEntry& entry : book_.TakeSession(session)) {
    EndAttempt(entry, absl::CancelledError("its worker left"));
  }
  if (const std::string name = roster_.NameOf(session); !name.empty())
    Log("worker left worker=" + name);
  roster_.End(session);
  return absl::OkStatus();
}

absl::Status Coordinator::DrainWorker(const std::string& name) {
  const std::lock_guard lock(mutex_);
  ORBWEAVE_RETURN_IF_ERROR(roster_.Drain(name));
  Log("worker drains worker=" + name);
  WakeAll();
  return absl::OkStatus();
}

void Coordinator::WorkerDied(std::string_view name) {
  const std::lock_guard lock(mutex_);
  const std::optional<uint64_t> session = roster_.SessionOf(name);
  if (!session) return;
  EndAttempts(book_.TakeSession(*session),
              absl::StrCat("the process of worker ", std::string(name), " ended"));
  roster_.End(*session);
}

absl::StatusOr<std::optional<Lease>> Coordinator::LeaseTask(uint64_t session,
                                                            uint32_t slot,
                                                            double wait_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_s);
  std::unique_lock lock(mutex_);
  while (true) {
    if (stopping_) return absl::UnavailableError("the coordinator is shutting down");
    ORBWEAVE_RETURN_IF_ERROR(roster_.Hear(session, clock_.NowSeconds()));
    if (roster_.IsDraining(session)) return absl::CancelledError("the worker is to leave");
    ExpireLeases();
    if (std::optional<Lease> lease = GrantNext(session, slot)) return lease;
    const auto now = std::chrono::steady_clock::now();
    if (now >= deadline) return std::nullopt;
    changed_.wait_for(lock, std::min<std::chrono::duration<double>>(kLook, deadline - now));
  }
}

std::optional<Coordinator::JobTask> Coordinator::NextTask(const std::string& worker,
                                                          double now_s) const {
  const std::vector<std::string> serving = roster_.Serving(now_s);
  if (!std::binary_search(serving.begin(), serving.end(), worker)) return std::nullopt;
  for (const auto& [number, id] : order_) {
    const auto ref = jobs_.at(id).machine->NextReady(worker, serving, now_s);
    if (ref) return JobTask{id, *ref};
  }
  const uint32_t slots = roster_.Slots(now_s);
  for (const auto& [number, id] : order_) {
    const auto ref = jobs_.at(id).machine->NextStraggler(worker, slots, now_s);
    if (ref) return JobTask{id, *ref};
  }
  return std::nullopt;
}

std::optional<Lease> Coordinator::GrantNext(uint64_t session, uint32_t slot) {
  const double now_s = clock_.NowSeconds();
  const std::string worker = roster_.NameOf(session);
  const std::optional<JobTask> next = NextTask(worker, now_s);
  if (!next) return std::nullopt;
  JobMachine& machine = *jobs_.at(next->job).machine;
  const TaskRef ref = next->task;
  const Lease lease{machine.TaskId(ref), ++last_epoch_, machine.Spec(ref), slot};
  machine.TaskLeased(ref, {lease.epoch, worker, slot}, now_s);
  book_.Grant({lease.epoch, lease.task, next->job, ref, session, now_s + options_.lease_s});
  return lease;
}

absl::StatusOr<HeartbeatReply> Coordinator::Heartbeat(uint64_t session,
                                                      const std::vector<LeaseProgress>& leases) {
  const std::lock_guard lock(mutex_);
  const double now_s = clock_.NowSeconds();
  ExpireLeases();
  ORBWEAVE_RETURN_IF_ERROR(roster_.Hear(session, now_s));
  HeartbeatReply reply{.shutdown = stopping_};
  for (const LeaseProgress& held : leases) {
    const LeaseEntry* entry = book_.Renew(held.epoch, held.task, session, now_s + options_.lease_s);
    if (entry == nullptr) {
      reply.cancelled.push_back(held.task);
    } else {
      jobs_.at(entry->job).machine->TaskProgressed({entry->ref, entry->epoch}, held.progress);
    }
  }
  return reply;
}

absl::Status Coordinator::CompleteTask(uint64_t session,
                                       const Lease& lease,
                                       const TaskResult& result) {
  for (const auto* blobs : {&result.outputs, &result.recipes}) {
    for (const Digest& blob : *blobs) {
      if (blobs_.Has(blob)) continue;
      return absl::InvalidArgumentError(absl::StrCat("the result of task ",
                                                     lease.task.ToShortHex(),
                                                     " names blob ",
                                                     blob.ToShortHex(),
                                                     ", never put"));
    }
  }
  std::unique_lock lock(mutex_);
  if (WasDoneBy(lease)) return absl::OkStatus();
  ExpireLeases();
  ORBWEAVE_ASSIGN_OR_RETURN(const LeaseEntry entry, book_.Take(lease.epoch, lease.task, session));
  const std::vector<LeaseEntry> others = book_.TakeTask(entry.job, entry.ref);
  const uint64_t run = jobs_.at(entry.job).run;
  lock.unlock();
  const absl::Status saved = journal_.SaveResult(lease.task, result);  // before it is acknowledged
  lock.lock();
  if (jobs_.at(entry.job).run != run) return saved;
  if (!saved.ok()) {
    for (const LeaseEntry& other : others)
      EndAttempt(other, absl::CancelledError("its result would not have been taken"));
    EndAttempt(entry, saved);
    return saved;
  }
  JobMachine& machine = *jobs_.at(entry.job).machine;
  machine.TaskDone({entry.ref, entry.epoch}, result, clock_.NowSeconds());
  roster_.CountTask(session, machine.FailedOn(entry.ref));
  WakeAll();
  return absl::OkStatus();
}

absl::Status Coordinator::FailTask(uint64_t session,
                                   const Lease& lease,
                                   const absl::Status& error) {
  if (error.ok()) return absl::InvalidArgumentError("a failure needs a reason");
  const std::lock_guard lock(mutex_);
  ExpireLeases();
  ORBWEAVE_ASSIGN_OR_RETURN(const LeaseEntry entry, book_.Take(lease.epoch, lease.task, session));
  EndAttempt(entry, error);
  return absl::OkStatus();
}

void Coordinator::EndAttempt(const LeaseEntry& entry, const absl::Status& error) {
  Job& job = jobs_.at(entry.job);
  if (job.machine->state() != JobState::kRunning) return;
  const TaskSpec& spec = job.machine->Spec(entry.ref);
  Log(absl::StrCat("task not done job=",
                   entry.job.ToShortHex(),
                   " stage=",
                   spec.stage,
                   " part=",
                   spec.part,
                   " worker=",
                   roster_.NameOf(entry.session),
                   " reason=\"",
                   error.message(),
                   "\""));
  const bool input_lost = ClassifyFailure(error.code()) == FailureClass::kInputLost;
  if (input_lost && job.reruns < kMaxReruns) {
    ++job.reruns;
    job.verify = true;
    StartRun(job, JobSpec(job.machine->spec()), JobPlan(job.machine->plan()));
  } else {
    job.machine->TaskFailed({entry.ref, entry.epoch}, error, clock_.NowSeconds());
  }
  if (job.machine->state() != JobState::kRunning) book_.DropJob(entry.job);
  WakeAll();
}

void Coordinator::EndAttempts(const std::vector<LeaseEntry>& entries, const std::string& reason) {
  for (const LeaseEntry& entry : entries) EndAttempt(entry, absl::UnavailableError(reason));
}

void Coordinator::ExpireLeases() {
  for (const LeaseEntry& entry : book_.TakeExpired(clock_.NowSeconds())) {
    EndAttempt(entry,
               absl::UnavailableError(
                   absl::StrCat("worker ", roster_.NameOf(entry.session), " went silent")));
  }
}

bool Coordinator::WasDoneBy(const Lease& lease) const {
  return std::any_of(jobs_.begin(), jobs_.end(), [&lease](const auto& item) {
    return item.second.machine->WasDoneBy(lease.task, lease.epoch);
  });
}

absl::StatusOr<Digest> Coordinator::SubmitJob(const JobSpec& spec) {
  absl::StatusOr<JobPlan> plan = options_.find_plan(spec.kind);
  if (!plan.ok()) return absl::InvalidArgumentError(plan.status().message());
  for (const Digest& input : spec.inputs) {
    if (blobs_.Has(input)) continue;
    return absl::NotFoundError(
        absl::StrCat("the job's input blob ", input.ToShortHex(), " is not stored"));
  }
  const Digest id = spec.Id();
  const std::lock_guard saving(saving_mutex_);
  std::unique_lock lock(mutex_);
  Job* known = FindJob(id);
  const bool is_running = known != nullptr && known->machine->state() == JobState::kRunning;
  if (is_running && known->verify) return id;
  const uint64_t next_number = order_.empty() ? 1 : order_.rbegin()->first + 1;
  const uint64_t number = known != nullptr ? known->number : next_number;
  lock.unlock();
  ORBWEAVE_RETURN_IF_ERROR(journal_.SaveJob({spec, JobState::kRunning, "", number}));
  lock.lock();
  Job& job = jobs_[id];
  job.number = number;
  job.verify = true;
  job.reruns = 0;
  order_[number] = id;
  StartRun(job, spec, *std::move(plan));
  Log(absl::StrCat(
      "job submitted job=", id.ToShortHex(), " kind=", spec.kind, " label=\"", spec.label, "\""));
  return id;
}

void Coordinator::StartRun(Job& job, const JobSpec& spec, JobPlan plan) {
  book_.DropJob(spec.Id());
  job.run = ++last_run_;
  job.saved = false;
  job.machine =
      std::make_unique<JobMachine>(spec, std::move(plan), options_.retry, clock_.NowSeconds());
  WakeAll();
}

absl::StatusOr<JobStatus> Coordinator::GetJob(const Digest& id) {
  const std::lock_guard lock(mutex_);
  ExpireLeases();
  const Job* job = FindJob(id);
  if (job == nullptr) return NoSuchJob(id);
  const double now_s = clock_.NowSeconds();
  JobStatus status = job->machine->Status(now_s);
  status.workers = roster_.Status(now_s);
  return status;
}

absl::StatusOr<std::vector<JobStatus>> Coordinator::ListJobs() {
  const std::lock_guard lock(mutex_);
  ExpireLeases();
  const double now_s = clock_.NowSeconds();
  std::vector<JobStatus> jobs;
  for (const auto& [number, id] : order_) {
    jobs.push_back(jobs_.at(id).machine->Status(now_s));
    jobs.back().workers = roster_.Status(now_s);
  }
  return jobs;
}

absl::Status Coordinator::CancelJob(const Digest& id) {
  {
    const std::lock_guard lock(mutex_);
    Job* job = FindJob(id);
    if (job == nullptr) return NoSuchJob(id);
    job->machine->JobIsCancelled(clock_.NowSeconds());
    if (job->machine->state() != JobState::kRunning) book_.DropJob(id);
  }
  SaveEnd(id);
  return absl::OkStatus();
}

absl::StatusOr<std::vector<TaskOutcome>> Coordinator::GetOutcomes(const Digest& id) {
  const std::lock_guard lock(mutex_);
  const Job* job = FindJob(id);
  if (job == nullptr) return NoSuchJob(id);
  return job->machine->Outcomes();
}

absl::StatusOr<std::vector<TaskTiming>> Coordinator::GetTimings(const Digest& id) {
  const std::lock_guard lock(mutex_);
  const Job* job = FindJob(id);
  if (job == nullptr) return NoSuchJob(id);
  return job->machine->Timings();
}

absl::StatusOr<std::vector<MeasuredTask>> Coordinator::GetCosts(const Digest& id) {
  const std::lock_guard lock(mutex_);
  const Job* job = FindJob(id);
  if (job == nullptr) return NoSuchJob(id);
  return job->machine->Costs();
}

void Coordinator::BeginShutdown() {
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  WakeAll();
}

Coordinator::Job* Coordinator::FindJob(const Digest& id) {
  const auto it = jobs_.find(id);
  return it == jobs_.end() ? nullptr : &it->second;
}

void Coordinator::Log(const std::string& line) const {
  if (options_.log) options_.log(line);
}

void Coordinator::WakeAll() {
  changed_.notify_all();
  to_plan_.notify_all();
}

std::optional<Digest> Coordinator::JobToPlan() const {
  for (const auto& [number, id] : order_) {
    if (jobs_.at(id).machine->StageToPlan()) return id;
  }
  return std::nullopt;
}

std::optional<Digest> Coordinator::JobToSave() const {
  for (const auto& [number, id] : order_) {
    const Job& job = jobs_.at(id);
    if (!job.saved && job.machine->state() != JobState::kRunning) return id;
  }
  return std::nullopt;
}

void Coordinator::RunPlanner(std::stop_token stop) {
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex_);
    to_plan_.wait(lock, stop, [this] { return JobToPlan() || JobToSave(); });
    const std::optional<Digest> to_plan = JobToPlan();
    const std::optional<Digest> to_save = JobToSave();
    lock.unlock();
    if (to_plan) PlanNextStage(*to_plan);
    if (to_save) SaveEnd(*to_save);
  }
}

void Coordinator::PlanNextStage(const Digest& id) {
  std::unique_lock lock(mutex_);
  const uint64_t run = jobs_.at(id).run;
  const JobMachine& machine = *jobs_.at(id).machine;
  const std::optional<uint32_t> stage = machine.StageToPlan();
  if (!stage) return;
  const JobSnapshot snapshot{
      machine.spec(), machine.plan(), *stage, machine.results(), jobs_.at(id).verify};
  lock.unlock();
  absl::StatusOr<PreparedStage> prepared =
      PrepareStage(snapshot, blobs_, journal_);  // files: without the lock
  lock.lock();
  Job& job = jobs_.at(id);
  if (job.run != run || job.machine->state() != JobState::kRunning) return;
  const double now_s = clock_.NowSeconds();
  if (prepared.ok()) {
    job.machine->StageBegins(std::move(prepared->tasks), std::move(prepared->found), now_s);
  } else {
    const std::string& name = snapshot.plan.stages[*stage].stage;
    job.machine->JobFails(Annotate(prepared.status(), "cannot plan stage " + name).ToString(),
                          now_s);
  }
  WakeAll();
}

void Coordinator::SaveEnd(const Digest& id) {
  const std::lock_guard saving(saving_mutex_);
  std::unique_lock lock(mutex_);
  Job& job = jobs_.at(id);
  if (job.saved || job.machine->state() == JobState::kRunning) return;
  const JobEntry entry{job.machine->spec(), job.machine->state(), job.machine->error(), job.number};
  job.saved = true;
  Log(absl::StrCat("job ended job=", id.ToShortHex(), " error=\"", entry.error, "\""));
  lock.unlock();
  // When this fails the job is found running after a restart, and its results end it again at once.
  (void)journal_.SaveJob(entry);
}

}  // namespace orbweave
