// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_keys.h"

#include <algorithm>
#include <cstdlib>
#include <map>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "security/secret_file.h"

namespace orbweave {
namespace {

std::string FromEnvironment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : value;
}

}  // namespace

absl::StatusOr<S3Keys> ParseS3Keys(std::string_view text) {
  S3Keys keys;
  std::map<std::string, std::string*> fields = {
      {"aws_access_key_id", &keys.access_key},
      {"aws_secret_access_key", &keys.secret_key},
      {"aws_session_token", &keys.session_token},
      {"region", &keys.region},
  };
  int number = 0;
  for (const absl::string_view untrimmed :
       absl::StrSplit(absl::string_view(text.data(), text.size()), '\n')) {
    ++number;
    const absl::string_view line = absl::StripAsciiWhitespace(untrimmed);
    if (line.empty() || line.front() == '#' || line.front() == '[') continue;
    const size_t equals = std::min(line.find('='), line.size());
    const auto field = fields.find(std::string(absl::StripAsciiWhitespace(line.substr(0, equals))));
    if (equals == line.size() || field == fields.end() || !field->second->empty())
      return absl::InvalidArgumentError(
          absl::StrCat("line ", number, " says nothing known, or what was said before"));
    *field->second = std::string(absl::StripAsciiWhitespace(line.substr(equals + 1)));
  }
  if (keys.access_key.empty() || keys.secret_key.empty())
    return absl::InvalidArgumentError("aws_access_key_id and aws_secret_access_key are wanted");
  return keys;
}

absl::StatusOr<S3Keys> FindS3Keys(const std::string& path) {
  if (!path.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadSecretFile(path));
    absl::StatusOr<S3Keys> keys = ParseS3Keys(text);
    if (!keys.ok()) return Annotate(keys.status(), path);
    return keys;
  }
  S3Keys keys{.access_key = FromEnvironment("AWS_ACCESS_KEY_ID"),
              .secret_key = FromEnvironment("AWS_SECRET_ACCESS_KEY"),
              .session_token = FromEnvironment("AWS_SESSION_TOKEN"),
              .region = FromEnvironment("AWS_REGION")};
  if (keys.region.empty()) keys.region = FromEnvironment("AWS_DEFAULT_REGION");
  if (!keys.access_key.empty() && !keys.secret_key.empty()) return keys;
  return absl::InvalidArgumentError(
      "an object store needs keys: set AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY, or name a "
      "file by --store-keys");
}

}  // namespace orbweave
