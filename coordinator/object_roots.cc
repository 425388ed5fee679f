// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/object_roots.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace orbweave {

absl::StatusOr<RootedObject> FindObject(const ObjectRoots& roots, const std::string& path) {
  for (const auto& [root, store] : roots) {
    const std::string top = root + "/";
    if (!path.starts_with(top)) continue;
    std::string key = path.substr(top.size());
    for (const absl::string_view part : absl::StrSplit(key, '/')) {
      if (part.empty() || part == "." || part == ".." || part.find('\0') != part.npos)
        return absl::InvalidArgumentError(absl::StrCat(path, " is no object's name"));
    }
    return RootedObject{store, std::move(key)};
  }
  return absl::NotFoundError(absl::StrCat(path,
                                          " is beneath no root of this coordinator; start it with "
                                          "--root NAME=s3://BUCKET/PREFIX"));
}

}  // namespace orbweave
