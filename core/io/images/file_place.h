// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/digest.h"
#include "core/base/stage_context.h"
#include "core/io/images/image_metadata.h"

namespace orbweave {

/// What a file is, whatever it is called.
struct FileFacts {
  Digest content{};  ///< zero when it could not be read
  uint64_t size_bytes = 0;
  ImageMetadata metadata{};
  std::string problem{};  ///< why it cannot be used as an image; empty when all is well
};

/// The facts of a file with these bytes.
[[nodiscard]] FileFacts FactsOf(std::string_view bytes);

/// Where files of a job lie: a folder, or a part of an object store. Thread-safe but for List.
class FilePlace {
 public:
  virtual ~FilePlace() = default;
  /// The place, for people: a path, or s3://bucket/prefix.
  [[nodiscard]] virtual std::string Name() const = 0;
  /// Everything below that is called like an image (IsCalledLikeAnImage), as name relative to the
  /// place with '/', in natural order, without what lies below the place that is named `except`
  /// (may be empty). Names with a part that begins with a dot are skipped.
  [[nodiscard]] virtual absl::StatusOr<std::vector<std::string>> List(
      const std::string& except, const StageContext& context) = 0;
  /// The whole name of the file that is called `name` here: the path of LinkFile (BlobDepot).
  [[nodiscard]] virtual std::string PathOf(const std::string& name) const = 0;
  /// Reads the listed file `name`. What is wrong with the file is told by its facts; an error says
  /// that nobody can know.
  [[nodiscard]] virtual absl::StatusOr<FileFacts> Look(const std::string& name,
                                                       const StageContext& context) = 0;
  /// The bytes of the listed file whose whole name this is (PathOf).
  [[nodiscard]] virtual absl::StatusOr<std::string> Read(const std::string& path,
                                                         const StageContext& context) = 0;
  /// Whether files come over a network, each in its time: then several are read at once.
  [[nodiscard]] virtual bool IsElsewhere() const = 0;
};

/// A folder. NotFound, PermissionDenied of List as of ListImageFiles; a file that cannot be read is
/// one with a problem.
[[nodiscard]] std::unique_ptr<FilePlace> FolderAt(const std::string& path);

}  // namespace orbweave
