// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/mask_names.h"

#include "core/io/text_fields.h"

namespace orbweave {
namespace {

/// What the mask of an image may be called, in lower case, the first first.
std::vector<std::string> CandidatesFor(const std::string& image_name) {
  const std::string name = LowerText(image_name);
  std::vector<std::string> candidates = {
      name + ".png", name.substr(0, name.rfind('.')) + ".png", name};
  for (size_t end = name.rfind('/'); end != std::string::npos && end > 0;
       end = name.rfind('/', end - 1))
    candidates.push_back(name.substr(0, end) + ".png");
  return candidates;
}

}  // namespace

MaskNames::MaskNames(const std::vector<std::string>& files) {
  for (const std::string& file : files) files_.emplace(LowerText(file), file);
}

MaskNames MaskNames::OneForAll(const std::string& file) {
  MaskNames names;
  names.for_all_ = file;
  return names;
}

std::string MaskNames::Find(const std::string& image_name) const {
  for (const std::string& candidate : CandidatesFor(image_name)) {
    if (const auto file = files_.find(candidate); file != files_.end()) return file->second;
  }
  return for_all_;
}

std::string MaskNames::TakeFor(const std::string& image_name) {
  std::string file = Find(image_name);
  used_.insert(file);
  return file;
}

std::vector<std::string> MaskNames::Unused() const {
  std::vector<std::string> unused;
  for (const auto& [lower, file] : files_) {
    if (!used_.contains(file)) unused.push_back(file);
  }
  return unused;
}

}  // namespace orbweave
