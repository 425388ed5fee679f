// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/journal_watch.h"

#include <utility>

#include "core/base/sleep.h"

namespace orbweave {

JournalWatch::JournalWatch(Journal& journal,
                           double period_s,
                           std::function<void(const absl::Status& why)> on_lost)
    : thread_([&journal, period_s, on_lost = std::move(on_lost)](const std::stop_token& stop) {
        while (SleepUnlessStopped(period_s, stop)) {
          const absl::Status status = journal.Confirm();
          if (!absl::IsFailedPrecondition(status)) continue;
          on_lost(status);
          return;
        }
      }) {}

}  // namespace orbweave
