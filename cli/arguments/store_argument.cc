// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/store_argument.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "cli/arguments/root_argument.h"
#include "core/storage/durable_file.h"
#include "objects/s3_store.h"

namespace orbweave {
namespace {

std::string NoteOf(const std::string& state_dir) { return state_dir + "/store.json"; }

absl::StatusOr<ObjectRoots> ObjectRootsOf(const StoreArgument& argument) {
  ObjectRoots roots;
  for (const auto& [name, place] : argument.roots) {
    if (!IsS3Address(place)) continue;
    ORBWEAVE_ASSIGN_OR_RETURN(std::shared_ptr<ObjectStore> store,
                              OpenS3Store(place, argument.keys));
    ORBWEAVE_ASSIGN_OR_RETURN(const S3Address address, ParseS3Address(place));
    if (!roots.try_emplace(address.ToText(), std::move(store)).second)
      return absl::InvalidArgumentError(absl::StrCat(address.ToText(), " is a root twice"));
  }
  return roots;
}

}  // namespace

bool StoreArgument::HasObjects() const {
  return !store.empty() ||
         std::ranges::any_of(roots, [](const auto& root) { return IsS3Address(root.second); });
}

FileRoots StoreArgument::Folders() const {
  FileRoots folders = roots;
  std::erase_if(folders, [](const auto& root) { return IsS3Address(root.second); });
  return folders;
}

absl::Status StoreArgument::OpenFor(CoordinatorOptions& coordinator) const {
  if (!store.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(coordinator.objects, OpenS3Store(store, keys));
    coordinator.object_limits = limits;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(coordinator.object_roots, ObjectRootsOf(*this));
  return absl::OkStatus();
}

CLI::Option* AddStoreKeysArgument(CLI::App& command, std::string& path) {
  return command.add_option(
      "--store-keys",
      path,
      "File of mode 0600 with aws_access_key_id, aws_secret_access_key and, where there are such, "
      "aws_session_token and region; without it AWS_ACCESS_KEY_ID and the others in the "
      "environment");
}

void AddStoreArguments(CLI::App& command, StoreArgument& argument) {
  command.add_option(
      "--store",
      argument.store,
      "Object store for large blobs, as s3://BUCKET/PREFIX?region=R or "
      "s3://BUCKET/PREFIX?endpoint=https://HOST; workers read and write there without keys");
  command
      .add_option("--store-put-limit",
                  argument.limits.put_bytes,
                  "With --store: bytes above which a blob is stored in parts, each of which is "
                  "tried again by itself (default: 5GiB, which no server takes more of)")
      ->transform(CLI::AsSizeValue(false))
      ->check(CLI::Range(kLeastObjectBytes, kMostPutBytes));
  command
      .add_option("--store-part",
                  argument.limits.part_bytes,
                  "With --store: bytes of such a part, more where there would be over 10,000 "
                  "(default: 64MiB; most servers take none below 5MiB)")
      ->transform(CLI::AsSizeValue(false))
      ->check(CLI::Range(kLeastObjectBytes, kMostPutBytes));
  AddRootArgument(command,
                  argument.roots,
                  "Folder, or s3://BUCKET/PREFIX as for --store, beneath which clients may name "
                  "images, instead of sending them (repeatable)");
}

absl::Status RememberStore(const std::string& state_dir, const StoreArgument& argument) {
  std::error_code error;
  const std::string keys =
      argument.keys.empty() ? "" : std::filesystem::absolute(argument.keys, error).string();
  const nlohmann::json note = {{"store", argument.store}, {"keys_file", keys}};
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(state_dir));
  return WriteFileDurably(state_dir, NoteOf(state_dir), note.dump() + "\n");
}

absl::StatusOr<StoreArgument> RememberedStore(const std::string& state_dir) {
  const absl::StatusOr<std::string> text = ReadWholeFile(NoteOf(state_dir));
  if (absl::IsNotFound(text.status())) return StoreArgument{};
  ORBWEAVE_RETURN_IF_ERROR(text.status());
  const nlohmann::json note = nlohmann::json::parse(*text, nullptr, false);
  if (!note.is_object() || !note.contains("store") || !note["store"].is_string() ||
      !note.contains("keys_file") || !note["keys_file"].is_string())
    return absl::DataLossError(NoteOf(state_dir) + " is damaged: give --store, or remove it");
  return StoreArgument{.store = note["store"], .keys = note["keys_file"]};
}

}  // namespace orbweave
