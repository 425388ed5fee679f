// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/bench/netns_engine.h"

#include <algorithm>
#include <csignal>
#include <map>
#include <optional>

#include "absl/strings/str_cat.h"
#include "cli/bench/bench_measure.h"
#include "cli/bench/node_network.h"
#include "cli/process/stop_signals.h"
#include "core/base/sleep.h"
#include "core/storage/durable_file.h"
#include "security/key_store.h"
#include "security/unix_time.h"

namespace orbweave {
namespace {

constexpr double kLook_s = 0.05;
/// What workers get to leave when the job is over.
constexpr double kFarewell_s = 30.0;

std::string NodeName(uint32_t number) { return absl::StrCat("node", number); }

class NetnsEngine final : public BenchEngine {
 public:
  NetnsEngine(const EngineArgument& argument,
              OptionArguments options,
              std::string keys,
              std::unique_ptr<NodeNetwork> network)
      : argument_(argument),
        options_(std::move(options)),
        keys_(std::move(keys)),
        network_(std::move(network)) {}

  absl::StatusOr<JobMeasurement> Run(const NodesRun& run) override {
    ORBWEAVE_RETURN_IF_ERROR(MakeFolder(run.folder));
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<LinkTraffic> before, Traffic(run.nodes));
    ORBWEAVE_RETURN_IF_ERROR(RunProcesses(run));
    ORBWEAVE_ASSIGN_OR_RETURN(JobMeasurement measurement, ReadMeasurement(run.folder));
    ORBWEAVE_ASSIGN_OR_RETURN(measurement.links, Traffic(run.nodes));
    for (size_t i = 0; i < before.size(); ++i) {
      measurement.links[i].in_bytes -= before[i].in_bytes;
      measurement.links[i].out_bytes -= before[i].out_bytes;
    }
    if (argument_.processors > 0.0)
      measurement.processors_per_slot = std::min(1.0, argument_.processors / argument_.cpus);
    measurement.link_gbit_per_s = 1e-3 * argument_.link_mbit;
    return measurement;
  }

 private:
  [[nodiscard]] absl::StatusOr<std::vector<LinkTraffic>> Traffic(uint32_t nodes) const {
    std::vector<LinkTraffic> traffic;
    for (uint32_t number = 1; number <= nodes; ++number) {
      ORBWEAVE_ASSIGN_OR_RETURN(traffic.emplace_back(), network_->TrafficOf(number));
    }
    return traffic;
  }

  [[nodiscard]] absl::StatusOr<ChildProcess> StartCoordinator(const NodesRun& run) const {
    std::vector<std::string> words = {"orbweave", "bench", "measure"};
    const std::vector<std::string> about = MeasureArguments(run, argument_.cpus, options_);
    words.insert(words.end(), about.begin(), about.end());
    words.insert(words.end(),
                 {"--output",
                  run.folder,
                  "--workers",
                  "0",
                  "--listen",
                  NodeNetwork::HubAddress() + ":0",
                  "--tls",
                  keys_ + "/coordinator",
                  "--announce",
                  run.folder + "/coordinator.json"});
    return network_->StartOnHub(words, run.folder + "/coordinator.log");
  }

  [[nodiscard]] absl::StatusOr<ChildProcess> StartWorker(const NodesRun& run,
                                                         uint32_t number) const {
    return network_->StartOnNode(number,
                                 {"orbweave",
                                  "work",
                                  "--join",
                                  "@" + run.folder + "/coordinator.json",
                                  "--tls",
                                  absl::StrCat(keys_, "/", NodeName(number)),
                                  "--name",
                                  NodeName(number),
                                  "--slots",
                                  absl::StrCat(argument_.cpus)},
                                 absl::StrCat(run.folder, "/", NodeName(number), ".log"));
  }

  /// The job from its first process to the end of its last.
  [[nodiscard]] absl::Status RunProcesses(const NodesRun& run) const {
    const StopSignals signals;
    ORBWEAVE_ASSIGN_OR_RETURN(ChildProcess coordinator, StartCoordinator(run));
    std::vector<ChildProcess> workers;
    for (uint32_t number = 1; number <= run.nodes; ++number) {
      ORBWEAVE_ASSIGN_OR_RETURN(workers.emplace_back(), StartWorker(run, number));
    }
    std::optional<std::string> end;
    while (!(end = coordinator.PollEnd())) {
      if (!SleepUnlessStopped(kLook_s, signals.token()))
        return absl::CancelledError("interrupted");  // which ends them all
      ORBWEAVE_RETURN_IF_ERROR(CheckAlive(run, workers));
    }
    if (*end != "exit code 0") {
      return absl::InternalError(absl::StrCat(
          "the coordinator ended with ", *end, ": see ", run.folder, "/coordinator.log"));
    }
    AwaitEnds(workers, signals.token());
    return absl::OkStatus();
  }

  /// Workers stay as long as their coordinator; a little longer does not hurt.
  static absl::Status CheckAlive(const NodesRun& run, std::vector<ChildProcess>& workers) {
    for (uint32_t i = 0; i < workers.size(); ++i) {
      const std::optional<std::string> end = workers[i].PollEnd();
      if (end && *end != "exit code 0") {
        return absl::InternalError(absl::StrCat(NodeName(i + 1),
                                                " ended with ",
                                                *end,
                                                ": see ",
                                                run.folder,
                                                "/",
                                                NodeName(i + 1),
                                                ".log"));
      }
    }
    return absl::OkStatus();
  }

  static void AwaitEnds(std::vector<ChildProcess>& workers, const std::stop_token& stop) {
    for (double left_s = kFarewell_s; left_s > 0.0; left_s -= kLook_s) {
      bool all_ended = true;
      for (ChildProcess& worker : workers) {
        (void)worker.PollEnd();
        all_ended = all_ended && !worker.IsRunning();
      }
      if (all_ended || !SleepUnlessStopped(kLook_s, stop)) return;
    }
  }

  EngineArgument argument_;
  OptionArguments options_;
  std::string keys_;
  std::unique_ptr<NodeNetwork> network_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<BenchEngine>> MakeNetnsEngine(const EngineArgument& argument,
                                                             const OptionArguments& options,
                                                             const std::string& scratch) {
  const uint32_t most = *std::ranges::max_element(argument.nodes);
  const double processors =
      argument.processors > 0.0 ? argument.processors : static_cast<double>(argument.cpus);
  ORBWEAVE_ASSIGN_OR_RETURN(
      std::unique_ptr<NodeNetwork> network,
      NodeNetwork::Make(most, {.processors = processors, .link_mbit = argument.link_mbit}));
  const std::string keys = scratch + "/keys";
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(scratch));
  ORBWEAVE_RETURN_IF_ERROR(MakeKeyStore(keys, "bench", {}, UnixNow()));
  for (uint32_t number = 1; number <= most; ++number)
    ORBWEAVE_RETURN_IF_ERROR(AddKeys(keys, {.name = NodeName(number)}, UnixNow()));
  return std::make_unique<NetnsEngine>(argument, options, keys, std::move(network));
}

}  // namespace orbweave
