// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include "coordinator/dispatcher.h"
#include "coordinator/job_service.h"
#include "coordinator/journal/journal.h"
#include "coordinator/kept_blobs.h"
#include "coordinator/pulse.h"
#include "coordinator/wanted_slots.h"
#include "core/base/clock.h"

namespace orbweave {

/// The coordinator's own thread: plans stages (which reads files, without the lock), notes in the
/// journal how jobs and attempts ended, and how many slots are wanted. What it is given outlives
/// it.
class Planner {
 public:
  /// `mutex` guards `dispatcher` and `wanted`.
  Planner(std::mutex& mutex,
          Dispatcher& dispatcher,
          WantedSlots& wanted,
          JobService& job_service,
          KeptBlobs& blobs,
          Journal& journal,
          const Clock& clock)
      : mutex_(mutex),
        dispatcher_(dispatcher),
        wanted_(wanted),
        job_service_(job_service),
        blobs_(blobs),
        journal_(journal),
        clock_(clock) {}

  void Start();
  /// There may be something to do.
  void Wake() { woken_.notify_all(); }
  /// It rests while it waits for the journal or for blobs.
  [[nodiscard]] const Pulse& pulse() const { return pulse_; }

 private:
  void Run(const std::stop_token& stop);
  [[nodiscard]] bool HasWork() const;
  /// With the lock.
  void NoteMoment();
  void Save(const LooseEnds& ends);
  /// When the coordinator ends: it finds them ended when it is started again.
  void SaveAllEnds();
  void SaveEnd(const Digest& job);
  void PlanNextStage(const Digest& id, const std::stop_token& stop);
  /// The stage, once the journal can be asked.
  [[nodiscard]] absl::StatusOr<PreparedStage> Prepare(const JobSnapshot& snapshot,
                                                      const std::stop_token& stop);

  std::mutex& mutex_;
  Dispatcher& dispatcher_;
  WantedSlots& wanted_;
  JobService& job_service_;
  KeptBlobs& blobs_;
  Journal& journal_;
  const Clock& clock_;
  Pulse pulse_;
  std::condition_variable_any woken_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
