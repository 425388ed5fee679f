// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <thread>

#include "coordinator/journal/journal.h"

namespace orbweave {

/// Asks a journal again and again whether it is still this coordinator's, also while nothing is
/// saved. A journal that cannot be reached is asked further.
class JournalWatch {
 public:
  /// `on_lost` is called once, from another thread, when another coordinator has the journal; then
  /// the watch is over. `journal` outlives it.
  JournalWatch(Journal& journal,
               double period_s,
               std::function<void(const absl::Status& why)> on_lost);

 private:
  std::jthread thread_;
};

}  // namespace orbweave
