// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/fleet/local_fleet.h"

#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "absl/strings/str_cat.h"
#include "cli/fleet/see_workers_off.h"
#include "cli/process/event_log.h"
#include "coordinator/journal/journal_copy.h"
#include "coordinator/journal/open_journal.h"
#include "coordinator/listen_address.h"
#include "core/base/sleep.h"
#include "worker/machine_offers.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

constexpr double kLook_s = 0.05;
/// What a worker gets between SIGTERM and SIGKILL to give its task back.
constexpr std::chrono::seconds kGrace{5};

}  // namespace

absl::StatusOr<std::unique_ptr<LocalFleet>> LocalFleet::Start(const LocalFleetOptions& options) {
  std::unique_ptr<LocalFleet> fleet(new LocalFleet(options));
  ORBWEAVE_RETURN_IF_ERROR(fleet->OpenCoordinator());
  const WorkerOffers machine = OffersOfMachine();
  const std::string logs = options.coordinator.state_dir + "/logs";
  for (uint32_t k = 1; k <= options.workers; ++k) {
    const std::string name = absl::StrCat("worker-", k);
    fleet->members_.push_back({.name = name,
                               .log_path = absl::StrCat(logs, "/", name, ".log"),
                               .offers = ShareOf(machine, k - 1, options.workers)});
  }
  fleet->supervisor_ =
      std::jthread([raw = fleet.get()](const std::stop_token& stop) { raw->Supervise(stop); });
  return fleet;
}

absl::Status LocalFleet::OpenCoordinator() {
  ORBWEAVE_ASSIGN_OR_RETURN(EventLog file_log,
                            OpenEventLog(CoordinatorLogPath(options_.coordinator.state_dir)));
  ORBWEAVE_ASSIGN_OR_RETURN(monitoring_,
                            Monitoring::Start(options_.monitoring, std::move(file_log)));
  options_.coordinator.log = monitoring_->Log();
  options_.coordinator.open_journal =
      [this](const std::string& state_dir) -> absl::StatusOr<std::unique_ptr<Journal>> {
    ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<Journal> journal,
                              OpenJournalIn(JournalFolder(), state_dir, options_.coordinator.log));
    return monitoring_->Meter(std::move(journal));
  };
  ORBWEAVE_ASSIGN_OR_RETURN(coordinator_, Coordinator::Open(options_.coordinator, clock_));
  ORBWEAVE_ASSIGN_OR_RETURN(pages_, monitoring_->ServePages(*coordinator_, clock_));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string socket, ChooseSocket());
  ORBWEAVE_ASSIGN_OR_RETURN(server_, GrpcServer::Start(*coordinator_, socket));
  return options_.door.IsOpen() ? OpenDoor() : absl::OkStatus();
}

absl::Status LocalFleet::OpenDoor() {
  const FleetDoor& door = options_.door;
  ORBWEAVE_ASSIGN_OR_RETURN(
      door_,
      GrpcServer::Start(*coordinator_,
                        door.listen,
                        {.tls_folder = door.tls_folder,
                         .used_tokens_folder = options_.coordinator.state_dir + "/used_tokens",
                         .log = options_.coordinator.log,
                         .roots = options_.roots}));
  ORBWEAVE_RETURN_IF_ERROR(Announce(door.announce, door_->address(), door.tls_folder));
  options_.coordinator.log({.event = "door_open", .message = "address=" + door_->address()});
  return absl::OkStatus();
}

void LocalFleet::CloseDoor() {
  if (farewell_ == Farewell::kDismissWorkers) {
    TakeBack(options_.door.announce, door_->address());
    SeeWorkersOff(*coordinator_, options_.coordinator.lease_s);
  }
  door_.reset();
}

std::string LocalFleet::JournalFolder() const {
  std::error_code error;
  const bool is_shared = !SharedFileSystemOf(options_.coordinator.state_dir).empty();
  if (!options_.journal_folder.empty() || !is_shared) return options_.journal_folder;
  return fs::temp_directory_path(error).string();
}

absl::StatusOr<std::string> LocalFleet::ChooseSocket() {
  std::error_code error;
  const std::string in_state =
      fs::absolute(options_.coordinator.state_dir, error).string() + "/coordinator.sock";
  if (CheckListenAddress("unix:" + in_state, Wire::kPlain).ok()) return "unix:" + in_state;
  std::string folder = (fs::temp_directory_path(error) / "orbweave-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) {
    return absl::PermissionDeniedError(absl::StrCat("cannot create a folder like ", folder));
  }
  short_folder_ = folder;
  return absl::StrCat("unix:", folder, "/coordinator.sock");
}

LocalFleet::~LocalFleet() {
  supervisor_ = {};
  pages_.reset();
  if (coordinator_) coordinator_->BeginShutdown(farewell_);
  if (door_) CloseDoor();
  server_.reset();
  std::error_code ignored;
  if (!short_folder_.empty()) fs::remove_all(short_folder_, ignored);
}

uint32_t LocalFleet::restarts() const {
  const std::lock_guard lock(mutex_);
  return restarts_;
}

absl::Status LocalFleet::Health() const {
  ORBWEAVE_RETURN_IF_ERROR(coordinator_->health());
  const std::lock_guard lock(mutex_);
  return health_;
}

absl::StatusOr<JobStatus> LocalFleet::RunJob(const JobSpec& job,
                                             const JobListener& listener,
                                             const std::stop_token& stop) {
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest id, coordinator_->SubmitJob(job));
  return WaitForJob(
      *coordinator_, id, listener, [this] { return Health(); }, stop);
}

absl::Status LocalFleet::StartMember(Member& member) const {
  std::vector<std::string> arguments = {"orbweave",
                                        "work",
                                        "--join",
                                        address(),
                                        "--name",
                                        member.name,
                                        "--threads",
                                        absl::StrCat(options_.threads_per_worker),
                                        "--memory",
                                        absl::StrCat(member.offers.memory_bytes),
                                        "--gpus",
                                        absl::StrCat(member.offers.gpus),
                                        "--grace",
                                        "0",
                                        "--parent-pid",
                                        absl::StrCat(::getpid())};
  if (options_.coordinator.objects == nullptr) {
    arguments.insert(arguments.end(), {"--blobs", BlobFolderOf(options_.coordinator.state_dir)});
  }
  ORBWEAVE_ASSIGN_OR_RETURN(member.process,
                            ChildProcess::SpawnSelf(arguments, {.log_path = member.log_path}));
  return absl::OkStatus();
}

void LocalFleet::Supervise(const std::stop_token& stop) {
  for (Member& member : members_) {
    const absl::Status started = StartMember(member);
    const std::lock_guard lock(mutex_);
    health_.Update(started);
  }
  while (!stop.stop_requested()) {
    ReviveDead();
    SleepUnlessStopped(kLook_s, stop);
  }
  EndMembers();
}

void LocalFleet::ReviveDead() {
  for (Member& member : members_) {
    const std::optional<std::string> end = member.process.PollEnd();
    if (!end) continue;
    coordinator_->WorkerDied(member.name);
    const std::lock_guard lock(mutex_);
    if (restarts_ == options_.max_restarts) {
      health_.Update(absl::InternalError(absl::StrCat("workers died ",
                                                      restarts_ + 1,
                                                      " times, last ",
                                                      member.name,
                                                      " (",
                                                      *end,
                                                      "): see ",
                                                      member.log_path)));
      continue;
    }
    ++restarts_;
    health_.Update(StartMember(member));
  }
}

void LocalFleet::EndMembers() {
  for (const Member& member : members_) member.process.Signal(SIGTERM);
  const auto deadline = std::chrono::steady_clock::now() + kGrace;
  for (Member& member : members_) {
    while (member.process.IsRunning() && !member.process.PollEnd() &&
           std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::duration<double>(kLook_s));
    }
  }
  members_.clear();  // kills who is left
}

}  // namespace orbweave
