// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace orbweave {

/// Calls `body(i)` for i in [0, count) on `num_threads` threads. Each call writes to its own slot;
/// callers reduce in slot order, so that results do not depend on `num_threads`. An exception of
/// `body` is rethrown here after all threads ended (that of the smallest index).
void ParallelFor(size_t count, int num_threads, const std::function<void(size_t)>& body);

}  // namespace orbweave
