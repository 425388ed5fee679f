// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/object_place.h"

#include <algorithm>
#include <array>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/base/sleep.h"
#include "core/base/status.h"
#include "core/io/images/list_files.h"
#include "core/io/natural_order.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

/// More than any panorama has, and what is held in memory of each that is read.
constexpr uint64_t kMostImageBytes = uint64_t{1} << 30;
constexpr uint64_t kMostTableBytes = uint64_t{1} << 28;
/// Between attempts at an object, each of which is some already (kMostAttempts).
constexpr std::array<double, 4> kPauses_s = {2.0, 5.0, 15.0, 30.0};

enum class KeyKind { kImage, kOther, kUnusable };

/// What a key is to a job. Its parts become folders of what is written: none may be empty, and
/// those that begin with a dot are hidden, as in a folder.
KeyKind KindOf(const std::string& name) {
  if (!IsCalledLikeAnImage(name)) return KeyKind::kOther;
  bool is_whole = true;
  for (const absl::string_view part : absl::StrSplit(name, '/')) {
    if (!part.empty() && part.front() == '.') return KeyKind::kOther;
    is_whole = is_whole && !part.empty();
  }
  return is_whole && name.find('\0') == std::string::npos ? KeyKind::kImage : KeyKind::kUnusable;
}

/// What to do about a bucket that is not there, or refuses.
absl::Status AdviseOnRefusal(const absl::Status& status) {
  const char* advice = "";
  if (absl::IsFailedPrecondition(status)) {
    advice = "; check the bucket's name, and region and endpoint in the address";
  } else if (absl::IsPermissionDenied(status)) {
    advice = "; the keys need the rights to list the bucket and to get its objects";
  }
  return {status.code(), absl::StrCat(status.message(), advice)};
}

/// What became of an object that was listed, and what to do.
absl::Status AdviseOnObject(const absl::Status& status, const std::string& path) {
  if (absl::IsNotFound(status)) {
    return absl::NotFoundError(absl::StrCat(
        path, " was removed while the images were read; put it back, or submit again without it"));
  }
  if (absl::IsAborted(status)) {
    return absl::DataLossError(
        absl::StrCat(path, " was changed while the images were read; submit again"));
  }
  if (absl::IsPermissionDenied(status)) {
    return absl::PermissionDeniedError(
        absl::StrCat(status.message(), "; the keys need the right to get it"));
  }
  return status;
}

absl::StatusOr<std::string> ReadTable(const std::string& text, const std::string& keys_path) {
  ORBWEAVE_ASSIGN_OR_RETURN(S3Address address, ParseS3Address(text));
  if (address.prefix.empty())
    return absl::InvalidArgumentError(absl::StrCat("'", text, "' names a bucket and no object"));
  const std::string name = address.ToText();
  const std::string key = std::exchange(address.prefix, {});
  ORBWEAVE_ASSIGN_OR_RETURN(S3Keys keys, FindS3Keys(keys_path));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto store, S3Store::Make(std::move(address), std::move(keys)));
  std::string bytes;
  const absl::Status read = store->Get(key, std::nullopt, [&](std::string_view piece) {
    bytes += piece;
    return bytes.size() <= kMostTableBytes
               ? absl::OkStatus()
               : absl::InvalidArgumentError(absl::StrCat(name, " is too large for a table"));
  });
  if (absl::IsNotFound(read))
    return absl::NotFoundError(absl::StrCat("there is no object ", name, "; check the address"));
  ORBWEAVE_RETURN_IF_ERROR(AdviseOnRefusal(read));
  return bytes;
}

absl::StatusOr<std::unique_ptr<FilePlace>> OpenPlace(const std::string& where,
                                                     const std::string& keys_path) {
  if (!IsS3Address(where)) return FolderAt(where);
  return ObjectPlace::Open(where, keys_path);
}

/// Masks in a store: below a prefix, or one object that is called like an image, for all images.
absl::Status OpenMasks(const ScanRequest& request, ImagePlaces& places) {
  std::string address = request.masks;
  const size_t end = std::min(address.find('?'), address.size());
  if (const std::string path = address.substr(0, end); IsCalledLikeAnImage(path)) {
    const size_t slash = path.rfind('/');
    places.mask_for_all = path.substr(slash + 1);
    address.erase(slash, end - slash);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(places.masks, ObjectPlace::Open(address, request.store_keys));
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::unique_ptr<ObjectPlace>> ObjectPlace::Open(const std::string& address,
                                                               const std::string& keys_path) {
  ORBWEAVE_ASSIGN_OR_RETURN(const S3Address parsed, ParseS3Address(address));
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<S3Store> store, OpenS3Store(address, keys_path));
  return std::unique_ptr<ObjectPlace>(new ObjectPlace(parsed.ToText(), std::move(store)));
}

absl::StatusOr<std::vector<std::string>> ObjectPlace::List(const std::string& except,
                                                           const StageContext& context) {
  // As in a folder: what lies below `except`, but not a place that itself lies below it.
  const bool is_here = except == name_ || except.starts_with(name_ + "/");
  const std::string beneath = is_here ? except + "/" : std::string();
  uint64_t seen = 0;
  listed_.clear();
  const absl::Status status = store_->ListPages([&](std::vector<ObjectInfo> page) -> absl::Status {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    for (ObjectInfo& object : page) {
      const KeyKind kind = KindOf(object.key);
      const std::string path = PathOf(object.key);
      if (kind == KeyKind::kOther || (!beneath.empty() && path.starts_with(beneath))) continue;
      if (kind == KeyKind::kUnusable) {
        return absl::InvalidArgumentError(absl::StrCat(
            path, ": a part of its key is empty, so it can be no file; rename or remove it"));
      }
      std::string name = object.key;
      listed_[std::move(name)] = std::move(object);
    }
    seen += page.size();
    context.Report(seen, 0, "objects");
    return absl::OkStatus();
  });
  ORBWEAVE_RETURN_IF_ERROR(AdviseOnRefusal(status));
  std::vector<std::string> names;
  for (const auto& [name, object] : listed_) names.push_back(name);
  std::sort(names.begin(), names.end(), NaturalLess);
  return names;
}

std::string ObjectPlace::PathOf(const std::string& name) const {
  return absl::StrCat(name_, "/", name);
}

absl::StatusOr<std::string> ObjectPlace::ReadOnce(const std::string& name,
                                                  const StageContext& context) {
  std::string bytes;
  ORBWEAVE_RETURN_IF_ERROR(
      store_->GetVersion(name, listed_.at(name).etag, [&](std::string_view piece) {
        bytes += piece;
        return context.CheckStop();
      }));
  return bytes;
}

absl::StatusOr<std::string> ObjectPlace::ReadListed(const std::string& name,
                                                    const StageContext& context) {
  absl::StatusOr<std::string> bytes = ReadOnce(name, context);
  for (const double pause_s : kPauses_s) {
    if (!absl::IsUnavailable(bytes.status())) break;
    SleepUnlessStopped(pause_s, context.stop);
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    bytes = ReadOnce(name, context);
  }
  if (!bytes.ok()) return AdviseOnObject(bytes.status(), PathOf(name));
  return bytes;
}

absl::StatusOr<FileFacts> ObjectPlace::Look(const std::string& name, const StageContext& context) {
  const uint64_t size_bytes = listed_.at(name).size_bytes;
  if (size_bytes > kMostImageBytes) {
    FileFacts facts;
    facts.size_bytes = size_bytes;
    facts.problem = absl::StrCat("it has ", size_bytes, " bytes, more than an image");
    return facts;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadListed(name, context));
  return FactsOf(bytes);
}

absl::StatusOr<std::string> ObjectPlace::Read(const std::string& path,
                                              const StageContext& context) {
  return ReadListed(path.substr(PathOf("").size()), context);
}

absl::StatusOr<ImagePlaces> OpenImagePlaces(const ScanRequest& request) {
  ImagePlaces places;
  ORBWEAVE_ASSIGN_OR_RETURN(places.images, OpenPlace(request.image_folder, request.store_keys));
  if (IsS3Address(request.masks)) {
    ORBWEAVE_RETURN_IF_ERROR(OpenMasks(request, places));
  } else if (!request.masks.empty()) {
    PlaceMasks(request.masks, places);
  }
  if (IsS3Address(request.gnss_table)) {
    ORBWEAVE_ASSIGN_OR_RETURN(places.gnss_bytes, ReadTable(request.gnss_table, request.store_keys));
  }
  return places;
}

}  // namespace orbweave
