// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"

namespace orbweave {

/// Who an S3 server knows us as. Written to no log and no error.
struct S3Keys {
  std::string access_key{};
  std::string secret_key{};
  std::string session_token{};  ///< empty: none
  std::string region{};         ///< empty: not said
};

/// The lines "aws_access_key_id = ...", "aws_secret_access_key = ...", "aws_session_token = ..."
/// and "region = ..." of a text, as Amazon's tools write them; lines "[...]" and those that begin
/// with '#' count for nothing. InvalidArgument, with the number of the line: another line; a key is
/// missing or stated twice.
[[nodiscard]] absl::StatusOr<S3Keys> ParseS3Keys(std::string_view text);

/// From the file `path` (which nobody else may read, see ReadSecretFile); when it is empty, from
/// AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, AWS_SESSION_TOKEN and AWS_REGION (or
/// AWS_DEFAULT_REGION) in the environment. InvalidArgument: a key is missing.
[[nodiscard]] absl::StatusOr<S3Keys> FindS3Keys(const std::string& path);

}  // namespace orbweave
