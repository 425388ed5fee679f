// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace orbweave {

/// What a process that runs tasks takes upon itself before the first one, while it has one thread:
///
///   - it dies when the thread that started it ends, however that happens;
///   - it leaves SIGINT and SIGTERM to that process, which gets them too and gives tasks back;
///   - the system takes it first when memory runs out, before the worker;
///   - beyond `memory_bytes` of its own it gets none (0: no such limit);
///   - it opens no sockets and gains no rights.
///
/// What the system does not offer is left out.
void ConfineProcess(uint64_t memory_bytes);

}  // namespace orbweave
