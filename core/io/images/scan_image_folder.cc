// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/scan_image_folder.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/parallel_for.h"
#include "core/io/first_names.h"
#include "core/io/printable_text.h"
#include "core/io/text_fields.h"
#include "core/io/text_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

constexpr size_t kNamesShown = 3;  ///< in a warning

/// Paths below the mask folder by their name in lower case.
using MaskIndex = std::map<std::string, std::string>;

absl::StatusOr<MaskIndex> IndexMasks(FilePlace* place, const StageContext& context) {
  MaskIndex index;
  if (place == nullptr) return index;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> names, place->List("", context));
  if (names.empty()) {
    return absl::NotFoundError(absl::StrCat(
        "the mask folder ",
        place->Name(),
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

absl::Status ScanImage(FilePlace& place, const StageContext& context, SourceImage& image) {
  image.path = place.PathOf(image.name);
  ORBWEAVE_ASSIGN_OR_RETURN(FileFacts facts, place.Look(image.name, context));
  image.content = facts.content;
  image.size_bytes = facts.size_bytes;
  image.metadata = std::move(facts.metadata);
  image.problem = std::move(facts.problem);
  return absl::OkStatus();
}

/// Turns the mask's name into its path and reads it. A mask that cannot be read keeps size 0 x 0,
/// which IngestImages reports.
absl::Status ScanMask(FilePlace* place, const StageContext& context, SourceImage& image) {
  if (image.mask_path.empty()) return absl::OkStatus();
  const std::string name = std::exchange(image.mask_path, place->PathOf(image.mask_path));
  ORBWEAVE_ASSIGN_OR_RETURN(const FileFacts facts, place->Look(name, context));
  image.mask = facts.content;
  if (!facts.problem.empty()) return absl::OkStatus();
  image.mask_width_px = facts.metadata.width_px;
  image.mask_height_px = facts.metadata.height_px;
  return absl::OkStatus();
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

void WarnOfValues(const std::string& what,
                  const std::vector<std::string>& images,
                  ImageSources& sources) {
  if (images.empty()) return;
  sources.warnings.push_back(absl::StrCat("the ",
                                          what,
                                          " of ",
                                          images.size(),
                                          images.size() == 1 ? " image" : " images",
                                          " is not used: ",
                                          FirstNames(images, kNamesShown)));
}

/// "the EXIF position of 2 images is not used: a.jpg (latitude -95, ...), ..." or nothing.
void WarnOfPositions(ImageSources& sources) {
  std::vector<std::string> left_out;
  for (const SourceImage& image : sources.images) {
    const std::string& problem = image.metadata.position_problem;
    if (!problem.empty()) left_out.push_back(absl::StrCat(image.name, " (", problem, ")"));
  }
  WarnOfValues("EXIF position", left_out, sources);
}

/// The same of other values: "the heading of 1 image is not used: a.jpg (1e+30)".
void WarnOfImpossibleValues(ImageSources& sources) {
  std::map<std::string, std::vector<std::string>> left_out;
  for (const SourceImage& image : sources.images) {
    for (const auto& [name, value] : image.metadata.left_out)
      left_out[name].push_back(absl::StrCat(image.name, " (", value, ")"));
  }
  for (const auto& [name, images] : left_out) WarnOfValues(name, images, sources);
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

/// Reads all of them, several at a time; the error of the first that has one.
absl::Status ScanAll(const ImagePlaces& places,
                     const StageContext& context,
                     ImageSources& sources) {
  const size_t count = sources.images.size();
  std::vector<absl::Status> errors(count);
  std::mutex mutex;
  std::atomic<bool> is_over{false};
  uint64_t done = 0;
  ParallelFor(count, std::max(context.num_threads, places.NumReaders()), [&](size_t i) {
    if (context.stop.stop_requested() || is_over) return;
    SourceImage& image = sources.images[i];
    errors[i] = ScanImage(*places.images, context, image);
    if (errors[i].ok()) errors[i] = ScanMask(places.masks.get(), context, image);
    if (!errors[i].ok()) is_over = true;
    RefuseOtherEncodings(image);
    const std::lock_guard lock(mutex);
    context.Report(++done, count, "images");
  });
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  for (const absl::Status& error : errors) ORBWEAVE_RETURN_IF_ERROR(error);
  return absl::OkStatus();
}

absl::Status ReadGnss(const ImagePlaces& places,
                      const ScanRequest& request,
                      ImageSources& sources) {
  const std::string& path = request.gnss_table;
  if (path.empty()) return absl::OkStatus();
  if (!places.gnss_bytes) return ReadGnssFile(path, sources);
  const std::string name = path.substr(0, path.find('?'));
  ORBWEAVE_ASSIGN_OR_RETURN(sources.gnss_text, TextOfFile(*places.gnss_bytes, name));
  sources.gnss_name = Utf8Text(fs::path(name).filename().string());
  return absl::OkStatus();
}

}  // namespace

absl::Status ReadGnssFile(const std::string& path, ImageSources& sources) {
  ORBWEAVE_ASSIGN_OR_RETURN(sources.gnss_text, ReadTextFile(path));
  sources.gnss_name = Utf8Text(fs::path(path).filename().string());
  return absl::OkStatus();
}

ImagePlaces FoldersOf(const ScanRequest& request) {
  ImagePlaces folders{.images = FolderAt(request.image_folder)};
  if (!request.mask_folder.empty()) folders.masks = FolderAt(request.mask_folder);
  return folders;
}

absl::StatusOr<ImageSources> ScanImageFolder(const ScanRequest& request,
                                             const StageContext& context) {
  return ScanImagePlaces(FoldersOf(request), request, context);
}

absl::StatusOr<ImageSources> ScanImagePlaces(const ImagePlaces& places,
                                             const ScanRequest& request,
                                             const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const MaskIndex masks, IndexMasks(places.masks.get(), context));
  const std::string except = places.masks ? places.masks->Name() : std::string();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> names,
                            places.images->List(except, context));
  if (names.empty()) {
    return absl::NotFoundError(
        absl::StrCat("no images in ",
                     places.images->Name(),
                     "; expected jpg, png, tif, bmp, webp, ppm or pgm files there or below"));
  }
  ImageSources sources;
  sources.mask_ignores_white = request.mask_ignores_white;
  ORBWEAVE_RETURN_IF_ERROR(ReadGnss(places, request, sources));
  AssignNamesAndMasks(names, masks, sources);
  ORBWEAVE_RETURN_IF_ERROR(ScanAll(places, context, sources));
  WarnOfPositions(sources);
  WarnOfImpossibleValues(sources);
  return sources;
}

}  // namespace orbweave
