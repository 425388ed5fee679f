// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/clock.h"
#include "core/base/file_descriptor.h"
#include "worker/task_runner.h"

namespace orbweave {

/// What a worker's task process does: runs the tasks that come over `socket` (see TaskProcess), one
/// after another, with the blobs the other end gives it. Returns when the other end is closed;
/// where that happens in the middle of a task, ends the process at once.
void ServeTasks(FileDescriptor socket, const StageLookup& stages, const Clock& clock);

}  // namespace orbweave
