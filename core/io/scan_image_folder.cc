// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/scan_image_folder.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>

#include "absl/strings/str_cat.h"
#include "core/base/parallel_for.h"
#include "core/io/file.h"
#include "core/io/first_names.h"
#include "core/io/list_files.h"
#include "core/io/printable_text.h"
#include "core/io/text_fields.h"
#include "core/io/text_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

constexpr size_t kNamesShown = 3;  ///< in a warning

/// Paths below the mask folder by their name in lower case.
using MaskIndex = std::map<std::string, std::string>;

absl::StatusOr<MaskIndex> IndexMasks(const std::string& folder) {
  MaskIndex index;
  if (folder.empty()) return index;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> names, ListImageFiles(folder, ""));
  if (names.empty()) {
    return absl::NotFoundError(absl::StrCat(
        "the mask folder ",
        folder,
        " holds no image; the mask of a/b.jpg is called a/b.png or a/b.jpg.png there"));
  }
  for (const std::string& name : names) index.emplace(LowerText(name), name);
  return index;
}

/// Name of an image's mask in the index; end() when it has none.
MaskIndex::const_iterator FindMask(const MaskIndex& masks, const std::string& image_name) {
  const std::string name = LowerText(image_name);
  const std::string stem = name.substr(0, name.rfind('.'));
  for (const std::string& candidate : {name + ".png", stem + ".png", name}) {
    if (const auto mask = masks.find(candidate); mask != masks.end()) return mask;
  }
  return masks.end();
}

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

void ScanImage(const std::string& folder, SourceImage& image) {
  image.path = (fs::path(folder) / image.name).string();
  const absl::StatusOr<std::string> bytes = ReadFile(image.path);
  if (!bytes.ok()) {
    image.problem = std::string(bytes.status().message());
    return;
  }
  image.content = DigestOf(*bytes);
  image.size_bytes = bytes->size();
  const absl::StatusOr<ImageMetadata> metadata = ReadImageMetadata(*bytes);
  if (metadata.ok()) {
    image.metadata = *metadata;
  } else {
    image.problem = DescribeProblem(metadata.status(), *bytes);
  }
}

/// Turns the mask's name into its path and reads it. A mask that cannot be read keeps size 0 x 0,
/// which IngestImages reports.
void ScanMask(const std::string& folder, SourceImage& image) {
  if (image.mask_path.empty()) return;
  image.mask_path = (fs::path(folder) / image.mask_path).string();
  const absl::StatusOr<std::string> bytes = ReadFile(image.mask_path);
  if (!bytes.ok()) return;
  image.mask = DigestOf(*bytes);
  const absl::StatusOr<ImageMetadata> metadata = ReadImageMetadata(*bytes);
  if (!metadata.ok()) return;
  image.mask_width_px = metadata->width_px;
  image.mask_height_px = metadata->height_px;
}

/// Names go into messages, which take UTF-8 alone.
void RefuseOtherEncodings(SourceImage& image) {
  image.problem = Utf8Text(image.problem);
  std::string name = Utf8Text(image.name);
  if (name == image.name) return;
  image.problem = "its name is not UTF-8: rename it";
  image.name = std::move(name);
}

/// "3 masks have no image: a.png, b.png, ..." or nothing.
void WarnOfUnusedMasks(const MaskIndex& masks,
                       const std::set<std::string>& used,
                       ImageSources& sources) {
  std::vector<std::string> unused;
  for (const auto& [lower, name] : masks) {
    if (!used.contains(lower)) unused.push_back(name);
  }
  if (unused.empty()) return;
  sources.warnings.push_back(Utf8Text(absl::StrCat(unused.size(),
                                                   unused.size() == 1 ? " mask has" : " masks have",
                                                   " no image: ",
                                                   FirstNames(unused, kNamesShown))));
}

/// "the EXIF position of 2 images is not used: a.jpg (latitude -95, ...), ..." or nothing.
void WarnOfPositions(ImageSources& sources) {
  std::vector<std::string> left_out;
  for (const SourceImage& image : sources.images) {
    const std::string& problem = image.metadata.position_problem;
    if (!problem.empty()) left_out.push_back(absl::StrCat(image.name, " (", problem, ")"));
  }
  if (left_out.empty()) return;
  sources.warnings.push_back(absl::StrCat("the EXIF position of ",
                                          left_out.size(),
                                          left_out.size() == 1 ? " image" : " images",
                                          " is not used: ",
                                          FirstNames(left_out, kNamesShown)));
}

/// One entry per name; `mask_path` is relative to the mask folder as yet.
void AssignNamesAndMasks(const std::vector<std::string>& names,
                         const MaskIndex& masks,
                         ImageSources& sources) {
  std::set<std::string> used;
  for (const std::string& name : names) {
    SourceImage& image = sources.images.emplace_back();
    image.name = name;
    const auto mask = FindMask(masks, name);
    if (mask == masks.end()) continue;
    image.mask_path = mask->second;
    used.insert(mask->first);
  }
  WarnOfUnusedMasks(masks, used, sources);
}

}  // namespace

absl::Status ReadGnssFile(const std::string& path, ImageSources& sources) {
  ORBWEAVE_ASSIGN_OR_RETURN(sources.gnss_text, ReadTextFile(path));
  sources.gnss_name = Utf8Text(fs::path(path).filename().string());
  return absl::OkStatus();
}

absl::StatusOr<ImageSources> ScanImageFolder(const ScanRequest& request,
                                             const StageContext& context) {
  std::error_code error;
  const std::string folder = fs::absolute(request.image_folder, error).string();
  const std::string mask_folder =
      request.mask_folder.empty() ? "" : fs::absolute(request.mask_folder, error).string();
  ORBWEAVE_ASSIGN_OR_RETURN(const MaskIndex masks, IndexMasks(mask_folder));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> names,
                            ListImageFiles(folder, mask_folder));
  if (names.empty()) {
    return absl::NotFoundError(
        absl::StrCat("no images in ",
                     folder,
                     "; expected jpg, png, tif, bmp, webp, ppm or pgm files there or below"));
  }
  ImageSources sources;
  sources.mask_ignores_white = request.mask_ignores_white;
  if (!request.gnss_table.empty()) {
    ORBWEAVE_RETURN_IF_ERROR(ReadGnssFile(request.gnss_table, sources));
  }
  AssignNamesAndMasks(names, masks, sources);
  std::mutex mutex;
  uint64_t done = 0;
  ParallelFor(names.size(), context.num_threads, [&](size_t i) {
    if (context.stop.stop_requested()) return;
    ScanImage(folder, sources.images[i]);
    ScanMask(mask_folder, sources.images[i]);
    RefuseOtherEncodings(sources.images[i]);
    const std::lock_guard lock(mutex);
    context.Report(++done, names.size(), "images");
  });
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  WarnOfPositions(sources);
  return sources;
}

}  // namespace orbweave
