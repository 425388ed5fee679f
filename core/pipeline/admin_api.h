// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

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
  /// Gives a worker no more tasks: it finishes what it has and leaves. It may join anew. NotFound:
  /// no such worker is there.
  [[nodiscard]] virtual absl::Status DrainWorker(const std::string& name) = 0;
  /// Removes blobs that no job on the list needs: to run, to go on after it failed or was
  /// cancelled, or to show its results. May end at any moment, and be repeated. FailedPrecondition:
  /// what a job needs cannot be told; nothing was removed. InvalidArgument: no number of seconds.
  [[nodiscard]] virtual absl::StatusOr<GarbageReport> CollectGarbage(
      const GarbageOptions& options) = 0;
};

}  // namespace orbweave
