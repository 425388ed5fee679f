// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <filesystem>

#include "coordinator/file_roots.h"
#include "coordinator/object_roots.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/temporary_folder.h"

namespace {

/// A root with a file, a link within and one that leads out to the file beside it.
orbweave::FileRoots MakeRoots(const orbweave::TemporaryFolder& folder) {
  const std::string root = folder.path() + "/root";
  std::filesystem::create_directories(root + "/a");
  folder.Write("root/a/b", "inside");
  folder.Write("outside", "outside");
  std::filesystem::create_symlink("a/b", root + "/in");
  std::filesystem::create_symlink("../outside", root + "/out");
  return {{"r", std::filesystem::canonical(root).string()}};
}

/// A key leads nowhere else, whatever path the server makes of it.
void TryObject(const std::string& path) {
  static const orbweave::ObjectRoots roots = {{"s3://b/r", nullptr}};
  const auto object = orbweave::FindObject(roots, path);
  if (!object.ok()) return;
  const std::filesystem::path key = object->key;
  ORBWEAVE_CHECK(path == "s3://b/r/" + object->key && key.is_relative() && !key.empty());
  ORBWEAVE_CHECK(key.lexically_normal() == key && *key.begin() != "..");
}

}  // namespace

FUZZ_TARGET(root_path) {
  static const orbweave::TemporaryFolder folder;
  static const orbweave::FileRoots roots = MakeRoots(folder);
  const std::string path(orbweave::BytesOf(data, size));
  const auto file = orbweave::ResolveBeneath(roots, "r", path);
  if (file.ok()) ORBWEAVE_CHECK(*file == roots.at("r") + "/a/b");
  TryObject(path);
  TryObject("s3://b/r/" + path);
}
