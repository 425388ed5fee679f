// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/bench/run_study.h"

#include <cstdio>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "cli/bench/measure_job.h"
#include "cli/bench/netns_engine.h"
#include "cli/bench/slurm_engine.h"
#include "cli/bench/write_corridor.h"

namespace orbweave {
namespace {

/// Nodes are worker processes of this machine.
class LocalEngine final : public BenchEngine {
 public:
  explicit LocalEngine(PipelineOptions options) : options_(std::move(options)) {}

  absl::StatusOr<JobMeasurement> Run(const NodesRun& run) override {
    return MeasureCorridorJob({.corridor = run.corridor,
                               .options = options_,
                               .folder = run.folder,
                               .fleet = {.workers = run.nodes},
                               .workers = run.nodes});
  }

 private:
  PipelineOptions options_;
};

struct Plan {
  ScalingKind kind;
  uint32_t nodes;
  uint32_t panoramas;
  uint32_t repeat;
};

/// Repeats come last, so that what disturbs a machine for a while disturbs not one size alone.
std::vector<Plan> PlansOf(const EngineArgument& argument) {
  std::vector<Plan> plans;
  for (uint32_t repeat = 0; repeat < argument.repeat; ++repeat) {
    for (const uint32_t nodes : argument.nodes) {
      if (argument.strong > 0)
        plans.push_back({ScalingKind::kStrong, nodes, argument.strong, repeat});
      if (argument.weak > 0)
        plans.push_back({ScalingKind::kWeak, nodes, nodes * argument.weak, repeat});
    }
  }
  return plans;
}

absl::StatusOr<std::string> CorridorOf(uint32_t panoramas, const std::string& scratch) {
  const std::string folder = absl::StrCat(scratch, "/corridor-", panoramas);
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) {
    ORBWEAVE_RETURN_IF_ERROR(
        WriteCorridor({.panoramas = static_cast<int>(panoramas)}, folder).status());
  }
  return folder;
}

absl::StatusOr<std::unique_ptr<BenchEngine>> MakeEngine(const EngineArgument& argument,
                                                        const OptionArguments& options,
                                                        const std::string& scratch) {
  if (argument.strong == 0 && argument.weak == 0)
    return absl::InvalidArgumentError("--engine needs --strong or --weak: how many panoramas");
  ORBWEAVE_ASSIGN_OR_RETURN(PipelineOptions read, ReadOptions(options));
  if (argument.engine == "netns") return MakeNetnsEngine(argument, options, scratch);
  if (argument.engine == "slurm") return MakeSlurmEngine(argument, options);
  if (argument.cpus != 1)
    return absl::InvalidArgumentError("--cpus is for netns and slurm: a local node has one slot");
  return std::make_unique<LocalEngine>(std::move(read));
}

}  // namespace

CLI::Option* AddEngineArguments(CLI::App& command, EngineArgument& argument) {
  CLI::Option* const engine =
      command
          .add_option("--engine",
                      argument.engine,
                      "Run a study on more and more nodes: worker processes (local), network "
                      "namespaces with a share of processors and a slow link (netns, as root), or "
                      "allocations of Slurm (slurm; --output on storage that all nodes see)")
          ->check(CLI::IsMember({"local", "netns", "slurm"}));
  command.add_option("--nodes", argument.nodes, "With --engine: numbers of nodes")
      ->delimiter(',')
      ->needs(engine)
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      .add_option("--strong",
                  argument.strong,
                  "With --engine: panoramas of a street that each number of nodes reconstructs")
      ->needs(engine)
      ->check(CLI::Range(2, 1'000'000));
  command
      .add_option("--weak",
                  argument.weak,
                  "With --engine: panoramas for each node, of a street that grows with them")
      ->needs(engine)
      ->check(CLI::Range(2, 1'000'000));
  command.add_option("--repeat", argument.repeat, "With --engine: how often each job is run")
      ->needs(engine)
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      .add_option(
          "--cpus", argument.cpus, "With netns and slurm: CPUs of a node: its tasks at a time")
      ->needs(engine)
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      .add_option("--node-processors",
                  argument.processors,
                  "With netns: processors that a node may use, as in 0.5: so more nodes than "
                  "processors can be tried (default: --cpus)")
      ->needs(engine)
      ->check(CLI::PositiveNumber);
  command
      .add_option(
          "--link-mbit", argument.link_mbit, "With netns: Mbit/s of a node's link, each way")
      ->needs(engine)
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--time", argument.time, "With slurm: time of an allocation, as sbatch takes it")
      ->needs(engine);
  command
      .add_option("--sbatch",
                  argument.sbatch,
                  "With slurm: a further option of sbatch, as in --sbatch=--account=city "
                  "(repeatable)")
      ->allow_extra_args(false)
      ->needs(engine);
  return engine;
}

absl::StatusOr<std::vector<StudyRun>> RunStudy(const EngineArgument& argument,
                                               const OptionArguments& options,
                                               const std::string& scratch) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto engine, MakeEngine(argument, options, scratch));
  const std::vector<Plan> plans = PlansOf(argument);
  std::vector<StudyRun> runs;
  for (const Plan& plan : plans) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string corridor, CorridorOf(plan.panoramas, scratch));
    std::fprintf(stderr,
                 "%zu of %zu: %u panoramas, %u nodes\n",
                 runs.size() + 1,
                 plans.size(),
                 plan.panoramas,
                 plan.nodes);
    const std::string folder = absl::StrCat(scratch, "/run-", runs.size());
    ORBWEAVE_ASSIGN_OR_RETURN(
        JobMeasurement job,
        engine->Run({.corridor = corridor, .nodes = plan.nodes, .folder = folder}));
    runs.push_back({.kind = plan.kind, .repeat = plan.repeat, .job = std::move(job)});
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  return runs;
}

}  // namespace orbweave
