// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/base/status.h"
#include "objects/object_store.h"

namespace orbweave {

/// The parts of object stores whose objects others may name to a coordinator: s3://bucket/prefix
/// (S3Address::ToText), and what reads there.
using ObjectRoots = std::map<std::string, std::shared_ptr<ObjectStore>>;

/// An object beneath a root.
struct RootedObject {
  std::shared_ptr<ObjectStore> store{};
  std::string key{};  ///< relative to the root
};

/// The object s3://bucket/prefix/key. NotFound: it is beneath no root. InvalidArgument: a part of
/// its key is empty, "." or "..".
[[nodiscard]] absl::StatusOr<RootedObject> FindObject(const ObjectRoots& roots,
                                                      const std::string& path);

}  // namespace orbweave
