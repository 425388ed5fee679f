// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace orbweave {

/// Lets this process and those it starts open as many files as the system allows at all: workers
/// keep large blobs as memory files, coordinators a connection per worker.
void RaiseFileLimit();

}  // namespace orbweave
