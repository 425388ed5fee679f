// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/stage_version.h"

#include <array>
#include <utility>

namespace orbweave {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kVersions = {{
    {"ingest_images", "1"},
    {"extract_features", "1"},
    {"select_image_pairs", "1"},
    {"match_images", "1"},
    {"verify_matches", "1"},
    {"partition_view_graph", "1"},
    {"reconstruct_cluster", "1"},
    {"align_submodels", "1"},
    {"merge_submodels", "1"},
    {"adjust_globally", "1"},
}};

}  // namespace

std::string_view StageVersion(std::string_view stage) {
  for (const auto& [name, version] : kVersions) {
    if (name == stage) return version;
  }
  return "0";
}

}  // namespace orbweave
