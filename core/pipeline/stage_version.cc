// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/stage_version.h"

#include <array>
#include <utility>

namespace orbweave {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 16> kVersions = {{
    {"ingest_images", "2"},
    {"extract_features", "2"},
    {"select_image_pairs", "3"},
    {"match_images", "4"},
    {"verify_matches", "4"},
    {"partition_view_graph", "9"},
    {"reconstruct_cluster", "6"},
    {"list_seams", "1"},
    {"fit_seams", "1"},
    {"align_submodels", "4"},
    {"review_seams", "1"},
    {"join_submodels", "4"},
    {"assemble_block", "4"},
    {"steer_adjustment", "3"},
    {"adjust_block", "4"},
    {"conclude_adjustment", "5"},
}};

}  // namespace

std::string_view StageVersion(std::string_view stage) {
  for (const auto& [name, version] : kVersions) {
    if (name == stage) return version;
  }
  return "0";
}

}  // namespace orbweave
