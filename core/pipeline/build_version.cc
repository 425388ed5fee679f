// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/build_version.h"

#include <string>

#include "core/base/digest.h"

namespace orbweave {

std::string_view BuildVersion() {
  static const std::string version = [] {
    const absl::StatusOr<Digest> executable = DigestOfFile("/proc/self/exe");
    const std::string build = executable.ok() ? executable->ToShortHex() : "unknown";
    return std::string(ORBWEAVE_VERSION "+") + build;
  }();
  return version;
}

}  // namespace orbweave
