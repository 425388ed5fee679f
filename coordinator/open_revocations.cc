// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/open_revocations.h"

#include <string>

namespace orbweave {

absl::StatusOr<std::shared_ptr<RevocationList>> OpenRevocations(const TlsFolder& folder,
                                                                const EventLog& log) {
  return RevocationList::Open(folder.RevocationsPath(), [log](const absl::Status& status) {
    if (!log) return;
    log({.level = LogLevel::kError,
         .event = "revocations_not_read",
         .message = std::string(status.message())});
  });
}

}  // namespace orbweave
