// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace orbweave {

/// The most memory this process has held in RAM (VmHWM of /proc/self/status) since it began or
/// since RestartPeakMemory; 0 where the system does not tell.
[[nodiscard]] uint64_t PeakMemoryBytes();

/// Lets the peak start anew from what the process holds now. Where the system does not allow that,
/// the peak stays that of the whole process.
void RestartPeakMemory();

}  // namespace orbweave
