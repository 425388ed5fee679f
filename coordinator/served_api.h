// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/pipeline/blob_grant.h"
#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// Told the answer to a question for a task, once.
using TakeLease = std::function<void(absl::StatusOr<std::optional<Lease>> answer)>;

/// How long a right to an object holds.
inline constexpr int kGrant_s = 600;

/// A coordinator that can be served without a thread for each worker that waits.
class ServedApi : public CoordinatorApi {
 public:
  /// LeaseTask that does not wait: `take` is told its answer, at once or from another thread, which
  /// it must not keep for long.
  virtual void AskForTask(uint64_t session,
                          uint32_t slot,
                          double wait_s,
                          const std::stop_token& left,
                          TakeLease take) = 0;

  /// Where each of these blobs is to be read or written; in an object store by a right that holds
  /// for kGrant_s. Empty: there is no such store. InvalidArgument: more than kMostGrants of them.
  [[nodiscard]] virtual absl::StatusOr<std::vector<BlobGrant>> GrantBlobs(
      const std::vector<WantedBlob>& blobs, GrantVerb verb) = 0;
  /// Ends what a grant of kParts began: the object is there, or nothing is. NotFound: there is no
  /// such upload any more. FailedPrecondition: there is no such store.
  [[nodiscard]] virtual absl::Status FinishUpload(const UploadEnd& end) = 0;
};

}  // namespace orbweave
