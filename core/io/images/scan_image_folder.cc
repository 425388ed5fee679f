// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/scan_image_folder.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/parallel_for.h"
#include "core/io/first_names.h"
#include "core/io/images/list_files.h"
#include "core/io/images/mask_names.h"
#include "core/io/printable_text.h"
#include "core/io/text_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

constexpr size_t kNamesShown = 3;  ///< in a warning

/// What `places` says of masks; none where there is no place of them.
absl::StatusOr<MaskNames> ListMasks(const ImagePlaces& places, const StageContext& context) {
  if (!places.masks) return MaskNames();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> names, places.masks->List("", context));
  const std::string& for_all = places.mask_for_all;
  if (for_all.empty() && !names.empty()) return MaskNames(names);
  if (std::find(names.begin(), names.end(), for_all) != names.end())
    return MaskNames::OneForAll(for_all);
  return absl::NotFoundError(
      for_all.empty()
          ? absl::StrCat("the mask folder ",
                         places.masks->Name(),
                         " holds no image; the mask of a/b.jpg is called a/b.png or a/b.jpg.png "
                         "there, that of all in a/ a.png")
          : absl::StrCat("there is no mask ", places.masks->PathOf(for_all), "; check the path"));
}

/// Names of images: not of what lies in the folder of masks, nor of the mask for all.
absl::StatusOr<std::vector<std::string>> ListImages(const ImagePlaces& places,
                                                    const StageContext& context) {
  const bool has_mask_folder = places.masks && places.mask_for_all.empty();
  ORBWEAVE_ASSIGN_OR_RETURN(
      std::vector<std::string> names,
      places.images->List(has_mask_folder ? places.masks->Name() : "", context));
  if (!places.mask_for_all.empty()) {
    const fs::path mask = fs::path(places.masks->PathOf(places.mask_for_all)).lexically_normal();
    std::erase_if(names, [&](const std::string& name) {
      return fs::path(places.images->PathOf(name)).lexically_normal() == mask;
    });
  }
  if (!names.empty()) return names;
  return absl::NotFoundError(
      absl::StrCat("no images in ",
                   places.images->Name(),
                   "; expected jpg, png, tif, bmp, webp, ppm or pgm files there or below"));
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

/// Names go into messages, which take UTF-8 alone.
void RefuseOtherEncodings(SourceImage& image) {
  image.problem = Utf8Text(image.problem);
  std::string name = Utf8Text(image.name);
  if (name == image.name) return;
  image.problem = "its name is not UTF-8: rename it";
  image.name = std::move(name);
}

/// "3 masks have no image: a.png, b.png, ..." or nothing.
void WarnOfUnusedMasks(const MaskNames& masks, ImageSources& sources) {
  const std::vector<std::string> unused = masks.Unused();
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

/// One entry per name; `mask_path` is relative to the place of masks as yet.
void AssignNamesAndMasks(const std::vector<std::string>& names,
                         MaskNames masks,
                         ImageSources& sources) {
  for (const std::string& name : names) {
    SourceImage& image = sources.images.emplace_back();
    image.name = name;
    image.mask_path = masks.TakeFor(name);
  }
  WarnOfUnusedMasks(masks, sources);
}

/// Does `look_at` for the first `count` numbers, several at a time, unless asked to stop; the error
/// of the first that has one.
absl::Status LookAtEach(size_t count,
                        int num_readers,
                        const StageContext& context,
                        const std::function<absl::Status(size_t)>& look_at) {
  std::vector<absl::Status> errors(count);
  std::atomic<bool> is_over{false};
  ParallelFor(count, std::max(context.num_threads, num_readers), [&](size_t i) {
    if (context.stop.stop_requested() || is_over) return;
    errors[i] = look_at(i);
    if (!errors[i].ok()) is_over = true;
  });
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  for (const absl::Status& error : errors) ORBWEAVE_RETURN_IF_ERROR(error);
  return absl::OkStatus();
}

absl::Status ScanImages(const ImagePlaces& places,
                        const StageContext& context,
                        ImageSources& sources) {
  std::mutex mutex;
  uint64_t done = 0;
  return LookAtEach(sources.images.size(), places.NumReaders(), context, [&](size_t i) {
    const absl::Status status = ScanImage(*places.images, context, sources.images[i]);
    RefuseOtherEncodings(sources.images[i]);
    const std::lock_guard lock(mutex);
    context.Report(++done, sources.images.size(), "images");
    return status;
  });
}

/// Turns the mask's name into its path and says what it is. A mask that cannot be read keeps size
/// 0 x 0, which IngestImages reports.
void SetMask(const FilePlace& place, const FileFacts& facts, SourceImage& image) {
  image.mask_path = place.PathOf(image.mask_path);
  image.mask = facts.content;
  if (!facts.problem.empty()) return;
  image.mask_width_px = facts.metadata.width_px;
  image.mask_height_px = facts.metadata.height_px;
}

/// Each mask is read once, however many images it is of.
absl::Status ScanMasks(const ImagePlaces& places,
                       const StageContext& context,
                       ImageSources& sources) {
  std::set<std::string> names;
  for (const SourceImage& image : sources.images) names.insert(image.mask_path);
  names.erase("");
  const std::vector<std::string> masks(names.begin(), names.end());
  std::vector<FileFacts> facts(masks.size());
  ORBWEAVE_RETURN_IF_ERROR(
      LookAtEach(masks.size(), places.NumReaders(), context, [&](size_t i) -> absl::Status {
        ORBWEAVE_ASSIGN_OR_RETURN(facts[i], places.masks->Look(masks[i], context));
        return absl::OkStatus();
      }));
  for (SourceImage& image : sources.images) {
    if (image.mask_path.empty()) continue;
    const auto mask = std::lower_bound(masks.begin(), masks.end(), image.mask_path);
    SetMask(*places.masks, facts[static_cast<size_t>(mask - masks.begin())], image);
  }
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

void PlaceMasks(const std::string& path, ImagePlaces& places) {
  const fs::path file(path);
  std::error_code error;
  if (!IsCalledLikeAnImage(path) || fs::is_directory(file, error)) {
    places.masks = FolderAt(path);
    return;
  }
  places.masks = FolderAt(file.has_parent_path() ? file.parent_path().string() : ".");
  places.mask_for_all = file.filename().string();
}

ImagePlaces FoldersOf(const ScanRequest& request) {
  ImagePlaces folders{.images = FolderAt(request.image_folder)};
  if (!request.masks.empty()) PlaceMasks(request.masks, folders);
  return folders;
}

absl::StatusOr<ImageSources> ScanImageFolder(const ScanRequest& request,
                                             const StageContext& context) {
  return ScanImagePlaces(FoldersOf(request), request, context);
}

absl::StatusOr<ImageSources> ScanImagePlaces(const ImagePlaces& places,
                                             const ScanRequest& request,
                                             const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(MaskNames masks, ListMasks(places, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> names, ListImages(places, context));
  ImageSources sources;
  sources.mask_ignores_white = request.mask_ignores_white;
  ORBWEAVE_RETURN_IF_ERROR(ReadGnss(places, request, sources));
  AssignNamesAndMasks(names, std::move(masks), sources);
  ORBWEAVE_RETURN_IF_ERROR(ScanImages(places, context, sources));
  ORBWEAVE_RETURN_IF_ERROR(ScanMasks(places, context, sources));
  WarnOfPositions(sources);
  WarnOfImpossibleValues(sources);
  return sources;
}

}  // namespace orbweave
