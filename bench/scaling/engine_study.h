// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/scaling/job_measurement.h"
#include "bench/scaling/share_time.h"

namespace orbweave {

/// Strong: the same street on more nodes. Weak: a street that grows with the nodes.
enum class ScalingKind { kStrong, kWeak };

/// A job that an engine ran.
struct StudyRun {
  ScalingKind kind = ScalingKind::kStrong;
  uint32_t repeat = 0;  ///< the same job on as many nodes, again
  JobMeasurement job{};
};

/// The same as a row of a table.
struct StudyPoint {
  ScalingKind kind = ScalingKind::kStrong;
  uint32_t nodes = 1;
  uint32_t repeat = 0;
  uint32_t panoramas = 0;
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< of all tasks
  /// Against the median of the fewest nodes: strong, of the time over nodes; weak, of the time.
  double efficiency = 1.0;
  double simulated_s = 0.0;
  double simulation_error = 0.0;  ///< simulated over measured, less one
  double coordinator_cpu_s = 0.0;
  double coordinator_ms_per_task = 0.0;
  uint64_t read_bytes = 0;     ///< by tasks, those in a worker's cache included
  uint64_t written_bytes = 0;  ///< by tasks
  std::vector<LinkTraffic> links{};
  TimeShares shares{};
};

/// What is said of an engine.
struct EngineFacts {
  std::string engine{};             ///< local, netns or slurm
  uint32_t machine_processors = 0;  ///< that all nodes share; 0: each node has its own
};

/// Jobs on more and more nodes of one engine.
struct EngineStudy {
  EngineFacts facts{};
  uint32_t slots = 1;  ///< of a node
  double processors_per_slot = 1.0;
  double link_gbit_per_s = 0.0;      ///< of a node; 0: no network, or nobody knows
  std::vector<StudyPoint> points{};  ///< strong before weak, by nodes, by repeat
  /// Nodes from which on the machine has not enough processors for all; 0: it has.
  uint32_t crowded_from = 0;
};

/// How far a simulated time may be off.
inline constexpr double kMostSimulationError = 0.15;

/// Times of a point that shares the kind and nodes of others: their median.
[[nodiscard]] double MedianWall(const EngineStudy& study, ScalingKind kind, uint32_t nodes);
/// Numbers of nodes of a kind, in order.
[[nodiscard]] std::vector<uint32_t> NodesOf(const EngineStudy& study, ScalingKind kind);

/// The study of `runs`. Each is simulated from tasks as they were measured on the fewest nodes (of
/// a street that grows: from its own), with the machines and the overhead of the first run on the
/// fewest nodes of its kind. CHECK: there is a run, and each ran now.
[[nodiscard]] EngineStudy BuildEngineStudy(const std::vector<StudyRun>& runs,
                                           const EngineFacts& facts);

}  // namespace orbweave
