// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal_watch.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace orbweave {

JournalWatch::JournalWatch(Journal& journal,
                           double period_s,
                           std::function<void(const absl::Status& why)> on_lost)
    : thread_([&journal, period_s, on_lost = std::move(on_lost)](const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any never;
        while (true) {
          std::unique_lock lock(mutex);
          never.wait_for(lock, stop, std::chrono::duration<double>(period_s), [] { return false; });
          if (stop.stop_requested()) return;
          const absl::Status status = journal.Confirm();
          if (!absl::IsFailedPrecondition(status)) continue;
          on_lost(status);
          return;
        }
      }) {}

}  // namespace orbweave
