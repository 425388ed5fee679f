// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

#include "objects/object_store.h"
#include "security/unix_time.h"

namespace orbweave::testing {

/// An object store in memory, of one thread, that can be away.
class MemoryObjects final : public ObjectStore {
 public:
  struct Object {
    std::string bytes{};
    int64_t modified_unix_s = 0;
  };

  absl::StatusOr<ObjectInfo> Head(const std::string& key) override {
    ++heads;
    ++calls;
    if (is_away) return absl::UnavailableError("away");
    const auto found = objects.find(key);
    if (found == objects.end()) return absl::NotFoundError(key);
    return ObjectInfo{"", found->second.bytes.size(), found->second.modified_unix_s};
  }
  absl::Status Get(const std::string& key,
                   const std::optional<ByteRange>&,
                   const TakePiece& take) override {
    ++calls;
    if (is_away) return absl::UnavailableError("away");
    const auto found = objects.find(key);
    if (found == objects.end()) return absl::NotFoundError(key);
    return take(found->second.bytes);
  }
  absl::Status Put(const std::string& key, const Digest&, std::string_view bytes) override {
    ++calls;
    if (is_away) return absl::UnavailableError("away");
    if (is_read_only) return absl::PermissionDeniedError("read only");
    objects.try_emplace(key, Object{loses_bytes ? "" : std::string(bytes), now_unix_s});
    return absl::OkStatus();
  }
  absl::Status Delete(const std::string& key) override {
    ++calls;
    if (on_delete) on_delete();
    if (is_away) return absl::UnavailableError("away");
    objects.erase(key);
    return absl::OkStatus();
  }
  absl::StatusOr<std::vector<ObjectInfo>> List() override {
    ++lists;
    ++calls;
    if (is_away) return absl::UnavailableError("away");
    std::vector<ObjectInfo> infos;
    for (const auto& [key, object] : objects)
      infos.push_back({key, object.bytes.size(), object.modified_unix_s});
    if (on_list) on_list();
    return infos;
  }
  ObjectGrant GrantGet(const std::string& key, int) override { return {.url = "get " + key}; }
  ObjectGrant GrantPut(const std::string& key, const Digest&, uint64_t, int) override {
    return {.url = "put " + key};
  }
  absl::StatusOr<std::string> BeginUpload(const std::string& key) override {
    if (is_away) return absl::UnavailableError("away");
    const std::string upload = "upload " + std::to_string(uploads.size() + 1);
    uploads[upload] = {key, upload, now_unix_s};
    return upload;
  }
  ObjectGrant GrantPart(const std::string& key, const ObjectPart& part, int) override {
    return {.url = "put " + key + " " + part.upload + " " + std::to_string(part.number)};
  }
  absl::Status FinishUpload(const std::string& key,
                            const std::string& upload,
                            const std::vector<std::string>& etags) override {
    if (uploads.erase(upload) == 0) return absl::NotFoundError(upload);
    std::string bytes;
    for (const std::string& etag : etags) bytes += etag;
    objects.try_emplace(key, Object{bytes, now_unix_s});
    return absl::OkStatus();
  }
  absl::Status AbortUpload(const std::string&, const std::string& upload) override {
    if (is_away) return absl::UnavailableError("away");
    uploads.erase(upload);
    return absl::OkStatus();
  }
  absl::StatusOr<std::vector<UploadInfo>> ListUploads() override {
    std::vector<UploadInfo> infos;
    for (const auto& [name, info] : uploads) infos.push_back(info);
    return infos;
  }

  std::map<std::string, Object> objects;
  std::map<std::string, UploadInfo> uploads;
  int64_t now_unix_s = 1'000'000;
  bool is_away = false;
  bool is_read_only = false;
  bool loses_bytes = false;  ///< keeps nothing of what is put
  int calls = 0;             ///< of all kinds
  int heads = 0;
  int lists = 0;
  std::function<void()> on_delete{};  ///< just before an object goes
  std::function<void()> on_list{};    ///< just after they were looked at
};

}  // namespace orbweave::testing
