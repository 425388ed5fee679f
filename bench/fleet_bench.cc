// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Many light workers at one coordinator for a stated time: whether a task is lost or done twice,
// and what each costs the coordinator, which is a process of its own.
//
//   bench_fleet [workers [tasks of a job [minutes [seconds of a task]]]]

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "cli/process/event_log.h"
#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
#include "tests/support/command.h"
#include "tests/support/light_fleet.h"

namespace orbweave {
namespace {

using testing::Command;
using testing::LightFaults;
using testing::ReadAll;
using testing::TemporaryFolder;
using testing::WaitUntil;

struct FleetOptions {
  uint32_t workers = 200;
  size_t tasks = 50'000;
  double minutes = 10.0;
  double task_s = 0.5;
};

/// The coordinator's process: serves until SIGTERM.
int Coordinate(const std::string& folder) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  const SteadyClock clock;
  const auto log = OpenEventLog(folder + "/coordinator.log");
  ORBWEAVE_CHECK(log.ok());
  const auto coordinator = Coordinator::Open(
      {.state_dir = folder + "/state", .find_plan = testing::FindWidePlan, .log = *log}, clock);
  ORBWEAVE_CHECK(coordinator.ok());
  const auto server = GrpcServer::Start(**coordinator, "unix:" + folder + "/s");
  ORBWEAVE_CHECK(server.ok());
  std::fputs("ready\n", stderr);
  int signal = 0;
  sigwait(&signals, &signal);
  (*coordinator)->BeginShutdown();
  return EXIT_SUCCESS;
}

/// Of all threads, those that ended among them.
double CpuSecondsOf(pid_t process) {
  const std::string stat = ReadAll("/proc/" + std::to_string(process) + "/stat");
  std::istringstream fields(stat.substr(stat.rfind(')') + 1));
  std::string field;
  for (int i = 3; i < 14; ++i) fields >> field;
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// A number of a status file of /proc.
double NumberIn(const std::string& file, const std::string& name) {
  const std::string status = "\n" + ReadAll(file);
  return std::strtod(status.c_str() + status.find("\n" + name + ":") + name.size() + 2, nullptr);
}

double NumberOf(pid_t process, const std::string& name) {
  return NumberIn("/proc/" + std::to_string(process) + "/status", name);
}

/// How often threads that are there now went to sleep.
double SleepsOf(pid_t process) {
  double sleeps = 0.0;
  const std::string tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks))
    sleeps += NumberIn(task.path() / "status", "voluntary_ctxt_switches");
  return sleeps;
}

/// One job to its end.
LightFaults RunJob(ClientApi& api, testing::LightFleet& fleet, uint64_t first, size_t tasks) {
  const std::vector<Digest> recipes = testing::WideRecipes(first, tasks);
  const auto job = api.SubmitJob(*testing::PrepareWideJob(api, recipes));
  ORBWEAVE_CHECK(job.ok());
  const auto has_ended = [&] {
    const auto status = api.GetJob(*job);
    return status.ok() && status->state != JobState::kRunning;
  };
  while (!has_ended()) std::this_thread::sleep_for(std::chrono::seconds(1));
  const auto faults = testing::FaultsOf(api, *job, recipes, fleet.runs());
  ORBWEAVE_CHECK(faults.ok());
  return *faults;
}

/// What all slots cost the coordinator that wait for a task.
struct Waiting {
  double cpu_share = 0.0;  ///< CPU seconds per second
  double wakes_per_s = 0.0;
  double threads = 0.0;
  double megabytes = 0.0;
};

Waiting CostOfWaiting(pid_t coordinator) {
  constexpr double kSettle_s = 5.0;
  constexpr double kTime_s = 10.0;
  std::this_thread::sleep_for(std::chrono::duration<double>(kSettle_s));
  const double start_s = CpuSecondsOf(coordinator);
  const double sleeps = SleepsOf(coordinator);
  std::this_thread::sleep_for(std::chrono::duration<double>(kTime_s));
  return {.cpu_share = (CpuSecondsOf(coordinator) - start_s) / kTime_s,
          .wakes_per_s = (SleepsOf(coordinator) - sleeps) / kTime_s,
          .threads = NumberOf(coordinator, "Threads"),
          .megabytes = NumberOf(coordinator, "VmRSS") / 1024.0};
}

int Measure(const FleetOptions& options) {
  const TemporaryFolder folder;
  Command coordinator({"/proc/self/exe", "coordinate", folder.Path()});
  ORBWEAVE_CHECK(WaitUntil([&] { return !coordinator.ErrSoFar().empty(); }, 60.0));
  GrpcCoordinatorClient client("unix:" + (folder / "s"));
  testing::LightFleet fleet(folder / "s", folder.Path(), options.workers, options.task_s);
  const Waiting waiting = CostOfWaiting(coordinator.Pid());
  const SteadyClock clock;
  const double start_s = clock.NowSeconds();
  const double cpu_start_s = CpuSecondsOf(coordinator.Pid());
  LightFaults faults;
  uint64_t tasks = 0;
  while (tasks == 0 || clock.NowSeconds() - start_s < 60.0 * options.minutes) {
    const LightFaults more = RunJob(client, fleet, tasks, options.tasks);
    faults.lost += more.lost;
    faults.doubled += more.doubled;
    tasks += options.tasks;
  }
  const double wall_s = clock.NowSeconds() - start_s;
  const double cpu_s = CpuSecondsOf(coordinator.Pid()) - cpu_start_s;
  std::puts(
      "| workers | tasks | minutes | tasks / s | lost | doubled | coordinator, CPU ms per task "
      "| peak MB | while all wait: CPU ms per s | wakes per s | threads | MB "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|");
  std::printf(
      "| %u | %llu | %.1f | %.0f | %llu | %llu | %.2f | %.0f | %.1f | %.0f | %.0f | %.0f |\n",
      options.workers,
      static_cast<unsigned long long>(tasks),
      wall_s / 60.0,
      static_cast<double>(tasks) / wall_s,
      static_cast<unsigned long long>(faults.lost),
      static_cast<unsigned long long>(faults.doubled),
      1000.0 * cpu_s / static_cast<double>(tasks),
      NumberOf(coordinator.Pid(), "VmHWM") / 1024.0,
      1000.0 * waiting.cpu_share,
      waiting.wakes_per_s,
      waiting.threads,
      waiting.megabytes);
  std::fflush(stdout);  // many files are to be removed yet
  return faults.lost + faults.doubled == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 2 && arguments[0] == "coordinate")
    return orbweave::Coordinate(arguments[1]);
  orbweave::FleetOptions options;
  if (arguments.size() > 0) options.workers = static_cast<uint32_t>(std::stoul(arguments[0]));
  if (arguments.size() > 1) options.tasks = std::stoul(arguments[1]);
  if (arguments.size() > 2) options.minutes = std::stod(arguments[2]);
  if (arguments.size() > 3) options.task_s = std::stod(arguments[3]);
  return orbweave::Measure(options);
}
