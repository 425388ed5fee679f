// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/file_place.h"

#include <algorithm>
#include <filesystem>

#include "core/base/status.h"
#include "core/io/file.h"
#include "core/io/images/list_files.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// "is a text file ..." rather than "unknown kind" where the bytes look like text.
std::string DescribeUnknown(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 256);
  const bool text = std::all_of(head.begin(), head.end(), [](char c) {
    return (c >= ' ' && c <= '~') || c == '\n' || c == '\r' || c == '\t' ||
           (static_cast<unsigned char>(c) & 0x80) != 0;
  });
  return text ? "it is a text file, not an image" : "it is no image of a known kind";
}

std::string DescribeProblem(const absl::Status& status, std::string_view bytes) {
  if (status.message() == "not an image of a known kind") return DescribeUnknown(bytes);
  return std::string(status.message());
}

class Folder final : public FilePlace {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) {}

  std::string Name() const override { return path_; }
  absl::StatusOr<std::vector<std::string>> List(const std::string& except,
                                                const StageContext&) override {
    return ListImageFiles(path_, except);
  }
  std::string PathOf(const std::string& name) const override {
    return (fs::path(path_) / name).string();
  }
  absl::StatusOr<FileFacts> Look(const std::string& name, const StageContext&) override {
    const absl::StatusOr<std::string> bytes = ReadFile(PathOf(name));
    if (bytes.ok()) return FactsOf(*bytes);
    FileFacts facts;
    facts.problem = std::string(bytes.status().message());
    return facts;
  }
  absl::StatusOr<std::string> Read(const std::string& path, const StageContext&) override {
    return ReadFile(path);
  }
  bool IsElsewhere() const override { return false; }

 private:
  const std::string path_;
};

}  // namespace

FileFacts FactsOf(std::string_view bytes) {
  FileFacts facts;
  facts.content = DigestOf(bytes);
  facts.size_bytes = bytes.size();
  const absl::StatusOr<ImageMetadata> metadata = ReadImageMetadata(bytes);
  if (metadata.ok()) {
    facts.metadata = *metadata;
  } else {
    facts.problem = DescribeProblem(metadata.status(), bytes);
  }
  return facts;
}

std::unique_ptr<FilePlace> FolderAt(const std::string& path) {
  std::error_code error;
  return std::make_unique<Folder>(fs::absolute(path, error).string());
}

}  // namespace orbweave
