// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/used_tokens.h"

#include <filesystem>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/storage/durable_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// A file that does not say when its token expires is kept.
bool HasExpired(const std::string& path, int64_t now_unix_s) {
  const absl::StatusOr<std::string> text = ReadWholeFile(path);
  int64_t expires_unix_s = 0;
  return text.ok() && absl::SimpleAtoi(*text, &expires_unix_s) && expires_unix_s <= now_unix_s;
}

}  // namespace

absl::StatusOr<UsedTokens> UsedTokens::Open(const std::string& folder, int64_t now_unix_s) {
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(folder));
  ORBWEAVE_RETURN_IF_ERROR(MakeEmptyFolder(folder + "/tmp"));
  std::error_code error;
  std::vector<std::string> expired;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file(error) && HasExpired(entry.path().string(), now_unix_s))
      expired.push_back(entry.path().string());
  }
  for (const std::string& path : expired) fs::remove(path, error);
  return UsedTokens(folder);
}

absl::Status UsedTokens::Use(const std::string& nonce, int64_t expires_unix_s) {
  const std::lock_guard lock(*mutex_);
  const std::string path = absl::StrCat(folder_, "/", nonce);
  std::error_code error;
  const fs::file_type found = fs::symlink_status(path, error).type();
  if (found == fs::file_type::not_found)
    return WriteFileDurably(folder_ + "/tmp", path, absl::StrCat(expires_unix_s));
  return absl::PermissionDeniedError("the join token was used before: ask for a new one");
}

}  // namespace orbweave
