// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/status.h"
#include "core/pipeline/blob_grant.h"
#include "orbweave/v1/coordinator.pb.h"

namespace orbweave {

/// What is asked of GrantBlobs.
struct BlobQuestion {
  std::vector<WantedBlob> blobs{};
  GrantVerb verb = GrantVerb::kGet;
};

/// FromProto: InvalidArgument: no digest, a verb or place that nobody knows, a part or a name that
/// no server has.
[[nodiscard]] v1::GrantBlobsRequest ToProto(const BlobQuestion& question);
[[nodiscard]] absl::StatusOr<BlobQuestion> FromProto(const v1::GrantBlobsRequest& proto);
[[nodiscard]] v1::GrantBlobsReply ToProto(const std::vector<BlobGrant>& grants);
[[nodiscard]] absl::StatusOr<std::vector<BlobGrant>> FromProto(const v1::GrantBlobsReply& proto);
[[nodiscard]] v1::FinishUploadRequest ToProto(const UploadEnd& end);
[[nodiscard]] absl::StatusOr<UploadEnd> FromProto(const v1::FinishUploadRequest& proto);

}  // namespace orbweave
