// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/jobs/task_record.h"
#include "coordinator/traceparent.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

/// What went on between two moments, as OpenTelemetry has it.
struct TraceSpan {
  std::string trace_id{};   ///< 32 hexadecimal digits
  uint64_t id = 0;          ///< never 0
  std::string parent_id{};  ///< 16 hexadecimal digits; empty: none
  std::string name{};
  uint64_t start_ns = 0;  ///< since 1970, as all times here
  uint64_t end_ns = 0;
  std::map<std::string, std::string> texts{};  ///< attributes
  std::map<std::string, uint64_t> numbers{};
  std::optional<std::string> error{};  ///< why it failed; nothing: it did not
};

/// 16 hexadecimal digits.
[[nodiscard]] std::string SpanIdText(uint64_t id);

/// Makes spans of what happens to jobs: one of each job; in it one of each run of a stage, from the
/// first lease to the last end; in that one of each attempt, from its lease, or from the end of the
/// slot's attempt before, to its end.
///   trace id   of the span that asked for the job, or else the first half of the job's digest
///   span ids   of job and stage run: a digest of the job, the epoch since which it runs and the
///              run's number; of an attempt: its epoch xor the job's span id
/// so that a coordinator that is started again goes on with the same. Attempts that began before it
/// was have no span. Pure bookkeeping: time is handed in. Not thread-safe.
class JobSpans {
 public:
  /// The spans that end with an event.
  [[nodiscard]] std::vector<TraceSpan> Take(const LogEvent& event, uint64_t now_ns);

 private:
  struct StageSpan {
    uint32_t run = 0;
    uint64_t tasks = 0;   ///< attempts at them
    uint64_t failed = 0;  ///< of these
    TraceSpan span{};
  };
  struct JobSpan {
    uint64_t since_epoch = 0;
    uint32_t times_anew = 0;  ///< it went back to an earlier run
    TraceSpan span{};
    std::optional<StageSpan> stage{};
  };
  struct AttemptSpan {
    WorkerSlot at{};
    TraceSpan span{};
  };

  void JobBegins(const LogEvent& event, uint64_t now_ns);
  void JobEnds(const LogEvent& event, uint64_t now_ns, std::vector<TraceSpan>& ended);
  void AttemptBegins(const LogEvent& event, uint64_t now_ns, std::vector<TraceSpan>& ended);
  void AttemptEnds(const LogEvent& event, uint64_t now_ns, std::vector<TraceSpan>& ended);
  /// The span of the run that a lease belongs to; ends the one before.
  StageSpan& StageOf(const LogEvent& lease,
                     JobSpan& job,
                     uint64_t now_ns,
                     std::vector<TraceSpan>& ended);
  static void EndStage(JobSpan& job, std::vector<TraceSpan>& ended);
  /// Those that waited for their slot begin now.
  void LetNextBegin(const WorkerSlot& at, uint64_t gone, uint64_t now_ns);

  std::map<Digest, JobSpan> jobs_;
  std::map<uint64_t, AttemptSpan> attempts_;                 ///< that go on, by epoch
  std::map<WorkerSlot, std::vector<uint64_t>> epochs_at_{};  ///< of these
};

}  // namespace orbweave
