// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace orbweave {

/// Which blobs are garbage: no job names them, and nobody used them for a while.
struct GarbageOptions {
  /// What was put, asked for or found within this time stays: results that are not handed in yet,
  /// inputs of a job that is being submitted. Longer than any task and any upload.
  double unused_s = 86'400.0;
  bool dry_run = false;  ///< removes nothing
};

/// What a collection of garbage found. Files that are only linked count as blobs without bytes.
struct GarbageReport {
  uint64_t needed_blobs = 0;  ///< jobs name them
  uint64_t needed_bytes = 0;
  uint64_t recent_blobs = 0;  ///< nobody names them, but they were used
  uint64_t recent_bytes = 0;
  uint64_t removed_blobs = 0;  ///< or, in a dry run, would be
  uint64_t removed_bytes = 0;
  uint64_t forgotten_results = 0;  ///< of no job, and without their blobs; none in a dry run
};

/// What those who look after a coordinator ask of it. Every method is safe to call from several
/// threads and safe to repeat. Codes common to all: Unavailable (connection; try again).
class AdminApi {
 public:
  virtual ~AdminApi() = default;
  /// Gives workers no more tasks: they finish what they have and leave. They may join anew. `name`
  /// is that of one, or how that of one alone begins, or with '*' at its end how those of any
  /// number begin. Returns their names. NotFound: no such worker is there. InvalidArgument: several
  /// begin so.
  [[nodiscard]] virtual absl::StatusOr<std::vector<std::string>> DrainWorkers(
      const std::string& name) = 0;
  /// Ends the coordinator and sends its workers home. Its jobs go on when it is started again on
  /// the same state.
  [[nodiscard]] virtual absl::Status StopCoordinator() = 0;
  /// Removes blobs that no job on the list needs: to run, to go on after it failed or was
  /// cancelled, or to show its results. May end at any moment, and be repeated. FailedPrecondition:
  /// what a job needs cannot be told; nothing was removed. InvalidArgument: no number of seconds.
  [[nodiscard]] virtual absl::StatusOr<GarbageReport> CollectGarbage(
      const GarbageOptions& options) = 0;
};

}  // namespace orbweave
