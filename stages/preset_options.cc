// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/preset_options.h"

#include <array>
#include <utility>

namespace orbweave {
namespace {

/// Sections 3 to 5 of the paper; docs/benchmarks.md says what each stands for. A stage that learns
/// something the paper does not have gets a line here that turns it off.
constexpr std::array<std::string_view, 21> kPaper = {
    "mapping.preset=paper",
    "features.max_features=8192",
    "features.facades=off",
    "pairs.gnss_max_neighbours=10000",
    "pairs.gnss_min_neighbours=0",
    "pairs.first_neighbours=0",
    "pairs.predict=false",
    "retrieval.num_neighbours=0",
    "matching.guided=false",
    "two_view.solver=eight_point",
    "two_view.min_inliers=15",
    "two_view.max_log10_false_alarms=1000",
    "view_graph.min_closing_share=0",
    "partition.cluster_size=0",
    "partition.min_clusters=1",
    "partition.reviews=0",
    "global.gnss=off",
    "global.rounds=1",
    "global.attach_loose=false",
    "bundle.loss=least_squares",
    "bundle.residual=erp_px",
};

absl::StatusOr<PipelineOptions> OptionsOver(PipelineOptions options,
                                            std::string_view text,
                                            std::string_view source,
                                            const std::vector<std::string>& assignments) {
  ORBWEAVE_ASSIGN_OR_RETURN(options, PipelineOptionsFromText(text, source, std::move(options)));
  for (const std::string& assignment : assignments) {
    ORBWEAVE_RETURN_IF_ERROR(SetPipelineOption(options, assignment));
  }
  return options;
}

}  // namespace

std::vector<std::string> AssignmentsOf(MappingPreset preset) {
  if (preset == MappingPreset::kPaper) return {kPaper.begin(), kPaper.end()};
  return {};
}

PipelineOptions DefaultsOf(MappingPreset preset) {
  PipelineOptions options;
  for (const std::string& assignment : AssignmentsOf(preset))
    ORBWEAVE_CHECK(SetPipelineOption(options, assignment).ok());
  return options;
}

absl::StatusOr<PipelineOptions> OptionsOverPreset(std::string_view text,
                                                  std::string_view source,
                                                  const std::vector<std::string>& assignments) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions chosen,
                            OptionsOver({}, text, source, assignments));
  return OptionsOver(DefaultsOf(chosen.mapping.preset), text, source, assignments);
}

}  // namespace orbweave
