// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coordinator/coordinator.h"

namespace orbweave {

/// Of a coordinator that dismisses its workers (Farewell): waits until all have gone, or had the
/// time of two heartbeats to hear that they may.
void SeeWorkersOff(Coordinator& coordinator, double lease_s);

}  // namespace orbweave
