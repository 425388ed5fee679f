// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

namespace orbweave {

/// Sleeps until `seconds` have passed or it is asked to stop. Whether it was not asked to stop.
bool SleepUnlessStopped(double seconds, const std::stop_token& stop);

/// Sleeps until it is asked to stop.
void SleepUntilStopped(const std::stop_token& stop);

}  // namespace orbweave
