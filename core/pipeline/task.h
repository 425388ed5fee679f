// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/digest.h"

namespace orbweave {

/// The name of a computation: a stage, its inputs and its options. Equal specs have equal results,
/// so a result can be cached, repeated or computed twice without harm.
struct TaskSpec {
  std::string stage{};
  std::string version{};  ///< of the stage's algorithm
  std::vector<Digest> inputs{};
  std::string options_text{};  ///< canonical text of the sections the stage reads
  uint32_t part = 0;  ///< which part of the stage: for people and for order, not part of the id

  /// SHA-256 of stage, version, options and inputs.
  [[nodiscard]] Digest Id() const;
};

/// What computing a task took. Never part of a task's id, nor of what a stage computes from.
struct TaskCost {
  double wall_s = 0.0;
  double cpu_s = 0.0;
  uint64_t bytes_in = 0;           ///< of blobs read, those in the worker's cache included
  uint64_t bytes_out = 0;          ///< of blobs stored
  uint64_t peak_memory_bytes = 0;  ///< of the process that ran the task; 0: not known
};

/// What a stage leaves behind. All bulk is in blobs; the coordinator only ever sees their names.
struct TaskResult {
  std::vector<Digest> outputs{};
  /// One blob per part of the stage that follows: everything this part reads, by digest.
  std::vector<Digest> recipes{};
  std::string report_json{};  ///< counts and reasons, for the job's report; "{}" at least
  TaskCost cost{};            ///< filled in by whoever runs the task
};

/// A finished task of a job, and what it took when it was computed, now or in an earlier run.
struct MeasuredTask {
  uint32_t run = 0;  ///< stages count anew each time they run: loops run a stage several times
  std::string stage{};
  uint32_t part = 0;
  TaskCost cost{};
};

}  // namespace orbweave
