// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/find_image.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/options.h"

namespace orbweave {
namespace {

std::string_view BaseName(std::string_view name) { return name.substr(name.rfind('/') + 1); }

std::string_view WithoutEnding(std::string_view name) {
  const size_t dot = name.rfind('.');
  const size_t slash = name.rfind('/');
  const bool has_ending = dot != std::string_view::npos && dot > 0 &&
                          (slash == std::string_view::npos || dot > slash + 1);
  return has_ending ? name.substr(0, dot) : name;
}

std::string_view WithoutZeros(std::string_view digits) {
  const size_t first = digits.find_first_not_of('0');
  return first == std::string_view::npos ? digits.substr(0, 1) : digits.substr(first);
}

/// The number that a name without its ending ends in; empty: none.
std::string_view LastNumber(std::string_view stem) {
  const size_t last = stem.find_last_not_of("0123456789");
  return last == std::string_view::npos ? stem : stem.substr(last + 1);
}

/// Whether `text` is a number and the name ends in the same one.
bool HasNumber(std::string_view name, std::string_view text) {
  if (LastNumber(text) != text) return false;
  const std::string_view number = LastNumber(WithoutEnding(BaseName(name)));
  return !number.empty() && WithoutZeros(number) == WithoutZeros(text);
}

template <typename Means>
std::vector<ImageId> ImagesThat(const ImageManifest& manifest, Means means) {
  std::vector<ImageId> found;
  for (const ImageRecord& image : manifest.images) {
    if (means(std::string_view(image.name))) found.push_back(image.id);
  }
  return found;
}

absl::Status Ambiguous(const ImageManifest& manifest,
                       std::string_view text,
                       const std::vector<ImageId>& found) {
  constexpr size_t kShown = 3;
  std::string names;
  for (size_t i = 0; i < std::min(found.size(), kShown); ++i)
    names += (i == 0 ? "" : ", ") + manifest.At(found[i]).name;
  if (found.size() > kShown) names += ", ...";
  return absl::InvalidArgumentError("several images may be meant by '" + std::string(text) +
                                    "': " + names + "; write more of the name");
}

absl::Status Unknown(const ImageManifest& manifest, std::string_view text) {
  std::vector<std::string> names;
  for (const Exclusion& excluded : manifest.excluded) {
    if (excluded.name == text || BaseName(excluded.name) == text) {
      return absl::InvalidArgumentError(excluded.name +
                                        " takes no part in the job: " + excluded.reason);
    }
  }
  for (const ImageRecord& image : manifest.images) names.push_back(image.name);
  const std::string nearest = NearestName(text, names);
  return absl::NotFoundError(
      "the job has no image '" + std::string(text) + "'" +
      (nearest.empty() ? std::string() : "; did you mean '" + nearest + "'?"));
}

}  // namespace

absl::StatusOr<ImageId> FindImage(const ImageManifest& manifest, std::string_view text) {
  if (text.empty()) return absl::InvalidArgumentError("the name of an image is needed");
  const auto is_name = [&](std::string_view name) { return name == text; };
  const auto is_base = [&](std::string_view name) { return BaseName(name) == text; };
  const auto is_path = [&](std::string_view name) { return WithoutEnding(name) == text; };
  const auto is_stem = [&](std::string_view name) { return WithoutEnding(BaseName(name)) == text; };
  const auto has_number = [&](std::string_view name) { return HasNumber(name, text); };
  const auto ends_so = [&](std::string_view name) { return name.ends_with(text); };
  const auto stem_ends_so = [&](std::string_view name) {
    return WithoutEnding(name).ends_with(text);
  };
  for (const std::vector<ImageId>& found : {ImagesThat(manifest, is_name),
                                            ImagesThat(manifest, is_base),
                                            ImagesThat(manifest, is_path),
                                            ImagesThat(manifest, is_stem),
                                            ImagesThat(manifest, has_number),
                                            ImagesThat(manifest, ends_so),
                                            ImagesThat(manifest, stem_ends_so)}) {
    if (found.size() == 1) return found.front();
    if (found.size() > 1) return Ambiguous(manifest, text, found);
  }
  return Unknown(manifest, text);
}

}  // namespace orbweave
