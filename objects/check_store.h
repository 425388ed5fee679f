// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "objects/s3_store.h"

namespace orbweave {

/// One row of the contract that a store has to keep.
struct StoreCheck {
  std::string what{};
  absl::Status result{};
  bool is_needed = true;  ///< otherwise Orbweave gets by without it
};

/// Tries out all that Orbweave asks of a store, with objects of its own under "check/", which are
/// removed at the end. `make_store` opens the store as seen at a time: rights granted long ago are
/// to be refused.
[[nodiscard]] std::vector<StoreCheck> CheckStore(
    const std::function<absl::StatusOr<std::unique_ptr<S3Store>>(UnixClock clock)>& make_store);

}  // namespace orbweave
