// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "bench/scaling/job_measurement.h"

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

}  // namespace orbweave
