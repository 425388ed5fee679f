// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "cli/fleet/monitoring.h"
#include "cli/fleet/wait_for_job.h"
#include "cli/process/announce.h"
#include "coordinator/coordinator.h"
#include "coordinator/file_roots.h"
#include "coordinator/grpc/grpc_server.h"
#include "core/base/clock.h"
#include "worker/child_process.h"

namespace orbweave {

/// Where workers of other machines join.
struct FleetDoor {
  std::string listen{};      ///< empty: there is no such door
  std::string tls_folder{};  ///< as in ServerOptions
  AnnounceArgument announce{};

  [[nodiscard]] bool IsOpen() const { return !listen.empty(); }
};

struct LocalFleetOptions {
  CoordinatorOptions coordinator{};
  FleetDoor door{};
  FileRoots roots{};  ///< beneath which those who come by the door may name files
  MonitoringArgument monitoring{};
  /// Where the journal is, with a copy in the state folder; empty: in the state folder itself, or
  /// in that of temporary files where machines share its file system.
  std::string journal_folder{};
  uint32_t workers = 2;
  int threads_per_worker = 1;
  uint32_t max_restarts = 20;  ///< of all workers together
};

/// A coordinator in this process, listening on a unix socket in its state folder, and worker
/// processes of the same executable (`<self> work --join ...`), which end with it however it ends;
/// and, where it has a door, whoever joins there, who outlast it unless they are sent home.
/// With an object store they, too, have large blobs there, and not in the coordinator's folder.
/// A worker that dies is started again; its tasks go to others at once. Workers write
/// their log to `<state>/logs/worker-<n>.log`, the coordinator to `coordinator.log` beside them.
class LocalFleet {
 public:
  /// Errors: those of Coordinator::Open and GrpcServer::Start.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<LocalFleet>> Start(
      const LocalFleetOptions& options);
  /// Ends the workers (running tasks are given back), then the coordinator.
  ~LocalFleet();
  /// What is told to those who joined by the door when the fleet ends; unless this is called they
  /// are sent home.
  void ComesBack() { farewell_ = Farewell::kComeBack; }

  [[nodiscard]] ClientApi& coordinator() { return *coordinator_; }
  [[nodiscard]] const std::string& address() const { return server_->address(); }
  [[nodiscard]] uint32_t restarts() const;

  /// Submits a job and waits for its end; see WaitForJob. Unavailable: too many workers died.
  [[nodiscard]] absl::StatusOr<JobStatus> RunJob(const JobSpec& job,
                                                 const JobListener& listener,
                                                 const std::stop_token& stop);

 private:
  struct Member {
    std::string name{};
    std::string log_path{};
    WorkerOffers offers{};
    ChildProcess process{};
  };

  explicit LocalFleet(const LocalFleetOptions& options) : options_(options) {
    options_.coordinator.leases_survive = options_.door.IsOpen();  // our own workers do not
  }
  [[nodiscard]] absl::Status OpenCoordinator();
  [[nodiscard]] absl::StatusOr<std::string> ChooseSocket();
  /// Where the journal is kept besides the state folder; empty: nowhere.
  [[nodiscard]] std::string JournalFolder() const;
  [[nodiscard]] absl::Status OpenDoor();
  void CloseDoor();
  void Supervise(const std::stop_token& stop);
  [[nodiscard]] absl::Status StartMember(Member& member) const;
  void ReviveDead();
  void EndMembers();
  [[nodiscard]] absl::Status Health() const;

  LocalFleetOptions options_;
  SteadyClock clock_;
  std::string short_folder_;  ///< of the socket, when the state folder's path is too long for one
  std::unique_ptr<Monitoring> monitoring_;
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<HttpServer> pages_;  ///< null: nobody asked for them
  std::unique_ptr<GrpcServer> server_;
  std::unique_ptr<GrpcServer> door_;  ///< null: there is none
  Farewell farewell_ = Farewell::kDismissWorkers;
  std::vector<Member> members_;  ///< of the supervisor thread
  mutable std::mutex mutex_;
  uint32_t restarts_ = 0;
  absl::Status health_;
  std::jthread supervisor_;  ///< starts and ends all workers: they are told to die with the thread
                             ///< that started them
};

}  // namespace orbweave
