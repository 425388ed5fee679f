// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "core/base/status.h"

namespace orbweave {

/// The folders whose files others may name to a coordinator, each by a name of its own.
using FileRoots = std::map<std::string, std::string>;

/// The absolute path, free of symbolic links, of the file `relative` beneath root `root`. Every
/// step of the way is taken beneath the root: symbolic links may not lead out of it. NotFound: no
/// such root or file. PermissionDenied: the way leads out, or may not be read. InvalidArgument: no
/// regular file, or no path.
[[nodiscard]] absl::StatusOr<std::string> ResolveBeneath(const FileRoots& roots,
                                                         const std::string& root,
                                                         const std::string& relative);

}  // namespace orbweave
