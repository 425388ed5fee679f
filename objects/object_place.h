// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/io/images/file_place.h"
#include "core/io/images/scan_image_folder.h"
#include "objects/s3_store.h"

namespace orbweave {

/// The objects below a prefix as files: "a/b.jpg" is the object PREFIX/a/b.jpg. An object counts as
/// the one that was listed as long as its ETag is the same: another one, or none, is an error that
/// names it.
class ObjectPlace final : public FilePlace {
 public:
  /// At an address (ParseS3Address), with the keys of `keys_path` or the environment. Asks nobody
  /// yet. Errors of OpenS3Store.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<ObjectPlace>> Open(
      const std::string& address, const std::string& keys_path);

  [[nodiscard]] std::string Name() const override { return name_; }
  /// FailedPrecondition, PermissionDenied: no such bucket, no rights, and what to do.
  /// InvalidArgument: a key that no folder could have ("a//b.jpg"). Reports "objects".
  [[nodiscard]] absl::StatusOr<std::vector<std::string>> List(const std::string& except,
                                                              const StageContext& context) override;
  [[nodiscard]] std::string PathOf(const std::string& name) const override;
  /// DataLoss, NotFound: it was changed or removed since it was listed. What passes is tried
  /// again, with a minute of pauses; then Unavailable.
  [[nodiscard]] absl::StatusOr<FileFacts> Look(const std::string& name,
                                               const StageContext& context) override;
  /// As Look.
  [[nodiscard]] absl::StatusOr<std::string> Read(const std::string& path,
                                                 const StageContext& context) override;
  [[nodiscard]] bool IsElsewhere() const override { return true; }

 private:
  ObjectPlace(std::string name, std::unique_ptr<S3Store> store)
      : name_(std::move(name)), store_(std::move(store)) {}
  [[nodiscard]] absl::StatusOr<std::string> ReadListed(const std::string& name,
                                                       const StageContext& context);
  [[nodiscard]] absl::StatusOr<std::string> ReadOnce(const std::string& name,
                                                     const StageContext& context);

  const std::string name_;
  const std::unique_ptr<S3Store> store_;
  std::map<std::string, ObjectInfo> listed_;  ///< by name; of those that are called like images
};

/// The places of a request, folders or parts of object stores; a GNSS table that is an object is
/// read. Errors of ObjectPlace::Open and of reading the table.
[[nodiscard]] absl::StatusOr<ImagePlaces> OpenImagePlaces(const ScanRequest& request);

}  // namespace orbweave
