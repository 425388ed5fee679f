// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "coordinator/coordinator.h"
#include "coordinator/file_roots.h"
#include "core/base/status.h"

namespace orbweave {

/// Where a coordinator has blobs and images besides its state folder.
struct StoreArgument {
  std::string store{};  ///< address of an object store for large blobs; empty: none
  std::string keys{};   ///< file of its keys and of those to roots; empty: in the environment
  ObjectLimits limits{};
  std::map<std::string, std::string> roots{};  ///< by name: folders, and parts of object stores

  /// Whether there is anything that keys are for.
  [[nodiscard]] bool HasObjects() const;
  /// Roots that are folders.
  [[nodiscard]] FileRoots Folders() const;
  /// Opens the store and the roots that are parts of one, for the coordinator. InvalidArgument: two
  /// roots are the same; errors of OpenS3Store.
  [[nodiscard]] absl::Status OpenFor(CoordinatorOptions& coordinator) const;
};

/// Declares `--store-keys`.
CLI::Option* AddStoreKeysArgument(CLI::App& command, std::string& path);

/// Declares `--store`, `--store-put-limit`, `--store-part` and `--root`.
void AddStoreArguments(CLI::App& command, StoreArgument& argument);

/// Notes in the state folder where its large blobs are, for who opens it later: the address, and
/// which file has the keys. Errors of WriteFileDurably.
[[nodiscard]] absl::Status RememberStore(const std::string& state_dir,
                                         const StoreArgument& argument);
/// The store (and keys) of a state folder as they were noted; nothing where none was. DataLoss: the
/// note is damaged.
[[nodiscard]] absl::StatusOr<StoreArgument> RememberedStore(const std::string& state_dir);

}  // namespace orbweave
