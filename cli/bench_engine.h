// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bench/scaling/engine_study.h"
#include "cli/option_arguments.h"

namespace orbweave {

/// By whom jobs are run on more and more nodes.
struct EngineArgument {
  std::string engine{};  ///< local, netns or slurm; empty: nobody
  std::vector<uint32_t> nodes = {1, 2, 4};
  uint32_t strong = 0;  ///< panoramas of the street that all numbers of nodes do; 0: none
  uint32_t weak = 0;    ///< panoramas for each node; 0: none
  uint32_t repeat = 1;
  uint32_t cpus = 1;                  ///< of a node, and so its tasks at a time
  double processors = 0.0;            ///< of a node of netns; 0: as many as cpus
  double link_mbit = 1000.0;          ///< of a node of netns
  std::string time{};                 ///< of an allocation of slurm
  std::vector<std::string> sbatch{};  ///< further options of sbatch
};

/// Declares `--engine` and what belongs to it; returns `--engine`.
CLI::Option* AddEngineArguments(CLI::App& command, EngineArgument& argument);

/// One corridor on so many nodes.
struct NodesRun {
  std::string corridor{};  ///< folder, see WriteCorridor
  uint32_t nodes = 1;
  std::string folder{};  ///< of the run's state and logs
};

/// Runs jobs on nodes.
class BenchEngine {
 public:
  virtual ~BenchEngine() = default;
  [[nodiscard]] virtual absl::StatusOr<JobMeasurement> Run(const NodesRun& run) = 0;
};

/// `scratch`: a folder for what it needs, on storage that all nodes see. InvalidArgument,
/// FailedPrecondition: such nodes cannot be had here, and why.
[[nodiscard]] absl::StatusOr<std::unique_ptr<BenchEngine>> MakeBenchEngine(
    const EngineArgument& argument, const OptionArguments& options, const std::string& scratch);

/// All jobs of a study, in `scratch`; says on stderr how far it is. Errors of the engine.
[[nodiscard]] absl::StatusOr<std::vector<StudyRun>> RunStudy(const EngineArgument& argument,
                                                             const OptionArguments& options,
                                                             const std::string& scratch);

}  // namespace orbweave
