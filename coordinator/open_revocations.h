// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/pipeline/log_event.h"
#include "security/revocations.h"
#include "security/tls_folder.h"

namespace orbweave {

/// Whom a coordinator with the keys of `folder` no longer takes; see RevocationList. `log` is told
/// when the list becomes unreadable.
[[nodiscard]] absl::StatusOr<std::shared_ptr<RevocationList>> OpenRevocations(
    const TlsFolder& folder, const EventLog& log);

}  // namespace orbweave
