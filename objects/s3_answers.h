// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "objects/http_client.h"
#include "objects/object_store.h"

namespace orbweave {

/// What the answer of an S3 server means. `what` says what was asked for; `now_unix_s` is our own
/// time. NotFound: no such key. AlreadyExists: there is one (412). DataLoss: other bytes than were
/// signed. OutOfRange. Unavailable: slow down, a fault of the server, conflicting requests, a right
/// that has expired, a clock that is wrong. FailedPrecondition: no such bucket, another region.
/// Unimplemented: the server does not know what was asked. PermissionDenied: all other refusals.
[[nodiscard]] absl::Status StatusOfS3(const HttpAnswer& answer,
                                      const std::string& what,
                                      int64_t now_unix_s);

/// One page of a list.
struct ObjectPage {
  std::vector<ObjectInfo> objects{};  ///< with the whole keys
  std::string next{};  ///< the token of the page that follows; empty: this was the last
};

/// The answer to ListObjectsV2 with encoding-type=url. DataLoss: something else.
[[nodiscard]] absl::StatusOr<ObjectPage> ParseObjectPage(std::string_view xml);

/// The name of an upload that was begun. DataLoss: the answer has none.
[[nodiscard]] absl::StatusOr<std::string> ParseUpload(std::string_view xml);
/// The answer to ListMultipartUploads with encoding-type=url. DataLoss: something else.
[[nodiscard]] absl::StatusOr<std::vector<UploadInfo>> ParseUploads(std::string_view xml);
/// What CompleteMultipartUpload is sent.
[[nodiscard]] std::string PartsXml(const std::vector<std::string>& etags);
/// And what its answer of success means: servers begin it before they know, and may end it with an
/// error. Unavailable: such a one.
[[nodiscard]] absl::Status StatusOfFinish(const HttpAnswer& answer, const std::string& what);

/// "Wed, 21 Oct 2015 07:28:00 GMT" (RFC 9110, section 5.6.7) and "2009-10-12T17:50:30.000Z" in
/// seconds since 1970. InvalidArgument: neither.
[[nodiscard]] absl::StatusOr<int64_t> ParseHttpTime(const std::string& text);

}  // namespace orbweave
