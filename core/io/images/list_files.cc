// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/list_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/natural_order.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> kExtensions = {
    ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".bmp", ".webp", ".ppm", ".pgm"};

/// `visited` holds the real paths of folders that were entered or must not be.
absl::Status ListInto(const fs::path& folder,
                      const std::string& prefix,
                      std::set<fs::path>& visited,
                      std::vector<std::string>& names) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (!error && !visited.insert(real).second) return absl::OkStatus();
  fs::directory_iterator entries(folder, error);
  if (error) {
    return absl::PermissionDeniedError(
        absl::StrCat("cannot list the folder ", folder.string(), ": ", error.message()));
  }
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    if (entry.is_directory(error)) {
      ORBWEAVE_RETURN_IF_ERROR(ListInto(entry.path(), prefix + name + "/", visited, names));
    } else if (IsCalledLikeAnImage(name)) {
      names.push_back(prefix + name);
    }
  }
  return absl::OkStatus();
}

}  // namespace

bool IsCalledLikeAnImage(std::string_view path) {
  const std::string extension = LowerText(fs::path(path).extension().string());
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

absl::StatusOr<std::vector<std::string>> ListImageFiles(const std::string& folder,
                                                        const std::string& except) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return absl::NotFoundError(absl::StrCat("there is no folder ", folder, "; check the path"));
  }
  std::set<fs::path> visited;
  if (!except.empty()) visited.insert(fs::canonical(except, error));
  std::vector<std::string> names;
  ORBWEAVE_RETURN_IF_ERROR(ListInto(folder, "", visited, names));
  std::sort(names.begin(), names.end(), NaturalLess);
  return names;
}

}  // namespace orbweave
