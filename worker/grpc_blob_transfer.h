// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/status.h"
#include "core/pipeline/blob_access.h"
#include "orbweave/v1/coordinator.grpc.pb.h"

namespace orbweave {

/// See BlobAccess::Read. Unavailable: the blob was damaged on its way.
[[nodiscard]] absl::Status ReceiveBlob(v1::Coordinator::Stub& stub,
                                       const Digest& digest,
                                       const TakePiece& take);

/// See BlobAccess::Write. Unavailable: the blob was damaged on its way.
[[nodiscard]] absl::Status SendBlob(v1::Coordinator::Stub& stub,
                                    const Digest& digest,
                                    uint64_t size_bytes,
                                    const NextPiece& next);

}  // namespace orbweave
