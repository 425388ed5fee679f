// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "coordinator/journal/journal.h"

namespace orbweave {

/// Told each time something was saved: what ("job", "start", "result", "ends", "blames", "forget",
/// "probe"), the seconds until it was durable, and how that ended. Called from several threads.
using SaveObserver =
    std::function<void(std::string_view what, double wait_s, const absl::Status& status)>;

/// A journal whose saves are timed.
[[nodiscard]] std::unique_ptr<Journal> MeterJournal(std::unique_ptr<Journal> journal,
                                                    SaveObserver observer);

}  // namespace orbweave
