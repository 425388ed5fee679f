// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/text_file.h"

#include "core/base/status.h"
#include "core/io/file.h"
#include "core/io/printable_text.h"

namespace orbweave {

absl::StatusOr<std::string> ReadTextFile(const std::string& path) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  return TextOfFile(bytes, path);
}

absl::StatusOr<std::string> TextOfFile(const std::string& bytes, const std::string& path) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    return absl::InvalidArgumentError(path + " is UTF-16 text; save it as UTF-8");
  }
  if (bytes.find('\0') != std::string::npos) {
    return absl::InvalidArgumentError(
        path + " has zero bytes: it is no text, or UTF-16; save it as UTF-8");
  }
  return Utf8Text(bytes);
}

}  // namespace orbweave
