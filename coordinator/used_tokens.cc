// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/used_tokens.h"

#include <filesystem>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/storage/durable_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// What a file says: "EXPIRES USES".
struct Record {
  int64_t expires_unix_s = 0;
  uint32_t uses = 0;
};

absl::StatusOr<Record> ReadRecord(const std::string& path) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(path));
  const std::vector<std::string> words = absl::StrSplit(text, ' ');
  Record record;
  if (words.size() == 2 && absl::SimpleAtoi(words[0], &record.expires_unix_s) &&
      absl::SimpleAtoi(words[1], &record.uses)) {
    return record;
  }
  return absl::DataLossError(absl::StrCat(path, " does not say how often its token was used"));
}

/// A file that cannot be read is kept.
bool HasExpired(const std::string& path, int64_t now_unix_s) {
  const absl::StatusOr<Record> record = ReadRecord(path);
  return record.ok() && record->expires_unix_s <= now_unix_s;
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

absl::StatusOr<uint32_t> UsedTokens::Use(const JoinClaims& claims) {
  const std::lock_guard lock(*mutex_);
  const std::string path = absl::StrCat(folder_, "/", claims.nonce);
  const absl::StatusOr<Record> before = ReadRecord(path);
  if (!before.ok() && !absl::IsNotFound(before.status())) return before.status();
  const uint32_t use = before.ok() ? before->uses + 1 : 1;
  if (use > claims.uses)
    return absl::PermissionDeniedError("the join token was used before: ask for a new one");
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileDurably(folder_ + "/tmp", path, absl::StrCat(claims.expires_unix_s, " ", use)));
  return use;
}

}  // namespace orbweave
