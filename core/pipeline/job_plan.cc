// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_plan.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

InputRule JobInput(uint32_t index) { return {InputRule::Kind::kJobInput, "", index}; }
InputRule Output(std::string stage) { return {InputRule::Kind::kOutput, std::move(stage), 0}; }
InputRule Collection(std::string stage, uint32_t index) {
  return {InputRule::Kind::kCollection, std::move(stage), index};
}
InputRule AllOutputs(std::string stage) {
  return {InputRule::Kind::kAllOutputs, std::move(stage), 0};
}
InputRule Recipe() { return {InputRule::Kind::kRecipe, "", 0}; }

/// Everything before the view graph when images are given: the sources (job input 0) become a
/// manifest, features and verified pairs.
std::vector<StageRule> ImageStages() {
  return {
      {.stage = "ingest_images",
       .inputs = {JobInput(0)},
       .option_sections = {"ingest", "features"}},
      {.stage = "extract_features",
       .parts_from = "ingest_images",
       .inputs = {Recipe()},
       .option_sections = {"features", "retrieval"}},
      {.stage = "select_image_pairs",
       .inputs = {Output("ingest_images"), AllOutputs("extract_features")},
       .option_sections = {"pairs", "retrieval", "matching"}},
      {.stage = "match_images",
       .parts_from = "select_image_pairs",
       .inputs = {Recipe()},
       .option_sections = {"matching", "two_view"}},
  };
}

/// From verified pairs to the model. `manifest`, `features` and `clusters` (by hand; empty: none)
/// say where these come from, `matches_stage` which stage verified the pairs.
std::vector<StageRule> ModelStages(const InputRule& manifest,
                                   const InputRule& features,
                                   const InputRule& clusters,
                                   const std::string& matches_stage) {
  return {
      {.stage = "partition_view_graph",
       .inputs = {manifest,
                  features,
                  AllOutputs(matches_stage),
                  clusters,
                  Output("partition_view_graph"),
                  Output("review_seams")},
       .option_sections = {"view_graph", "partition"}},
      {.stage = "reconstruct_cluster",
       .parts_from = "partition_view_graph",
       .inputs = {Recipe()},
       .option_sections = {"mapping"}},
      {.stage = "list_seams",
       .inputs = {Output("partition_view_graph"), Collection("reconstruct_cluster", 1)}},
      {.stage = "fit_seams",
       .parts_from = "list_seams",
       .inputs = {Recipe()},
       .option_sections = {"align"}},
      {.stage = "align_submodels",
       .inputs = {Collection("fit_seams", 0)},
       .option_sections = {"align"}},
      {.stage = "review_seams",
       .inputs = {Output("partition_view_graph"),
                  Output("align_submodels"),
                  Output("review_seams")},
       .option_sections = {"partition"},
       .back_to = "partition_view_graph"},
      {.stage = "join_submodels",
       .inputs = {manifest,
                  Output("partition_view_graph"),
                  Collection("reconstruct_cluster", 0),
                  Collection("reconstruct_cluster", 1),
                  Output("align_submodels")},
       .option_sections = {"align", "global"}},
      {.stage = "assemble_block", .parts_from = "join_submodels", .inputs = {Recipe()}},
      {.stage = "steer_adjustment",
       .inputs = {Output("join_submodels"),
                  Collection("assemble_block", 0),
                  Output("steer_adjustment"),
                  Collection("adjust_block", 0)},
       .option_sections = {"global", "bundle", "blocks"}},
      {.stage = "adjust_block",
       .parts_from = "steer_adjustment",
       .inputs = {Recipe()},
       .option_sections = {"global", "bundle"},
       .back_to = "steer_adjustment"},
      {.stage = "conclude_adjustment",
       .inputs = {manifest,
                  Output("join_submodels"),
                  Output("steer_adjustment"),
                  Output("partition_view_graph")},
       .option_sections = {"global"}},
  };
}

JobPlan Joined(std::string kind,
               std::vector<StageRule> first,
               const std::vector<StageRule>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return {std::move(kind), std::move(first)};
}

JobPlan SparsePlan() {
  return Joined(
      "sparse",
      ImageStages(),
      ModelStages(
          Output("ingest_images"), AllOutputs("extract_features"), JobInput(1), "match_images"));
}

JobPlan SparseFromMatchesPlan() {
  const StageRule verify = {.stage = "verify_matches",
                            .parts_listed_in = 2,
                            .inputs = {Recipe()},
                            .option_sections = {"two_view"}};
  return Joined("sparse_from_matches",
                {verify},
                ModelStages(JobInput(0), JobInput(1), JobInput(3), "verify_matches"));
}

}  // namespace

absl::StatusOr<JobPlan> FindJobPlan(std::string_view kind) {
  if (kind == "sparse") return SparsePlan();
  if (kind == "sparse_from_matches") return SparseFromMatchesPlan();
  return absl::NotFoundError(absl::StrCat(
      "there is no job kind '", std::string(kind), "' (known: sparse, sparse_from_matches)"));
}

uint32_t StageAfter(const JobPlan& plan, uint32_t stage, const std::vector<TaskResult>& results) {
  const StageRule& last = plan.stages[stage];
  const std::string& back_to = last.back_to;
  const bool goes_on = std::ranges::any_of(
      results, [&](const TaskResult& part) { return !last.HasOnePart() || !part.recipes.empty(); });
  if (back_to.empty() || !goes_on) return stage + 1;
  const auto first = std::find_if(plan.stages.begin(),
                                  plan.stages.end(),
                                  [&](const StageRule& rule) { return rule.stage == back_to; });
  ORBWEAVE_CHECK(first - plan.stages.begin() <= stage);
  return static_cast<uint32_t>(first - plan.stages.begin());
}

std::string SelectSections(std::string_view options_text,
                           const std::vector<std::string>& sections) {
  std::string selected;
  while (!options_text.empty()) {
    const size_t length = std::min(options_text.find('\n'), options_text.size());
    const std::string_view line = options_text.substr(0, length);
    options_text.remove_prefix(std::min(length + 1, options_text.size()));
    const std::string_view section = line.substr(0, std::min(line.find('.'), line.size()));
    if (std::find(sections.begin(), sections.end(), section) == sections.end()) continue;
    selected.append(line).append("\n");
  }
  return selected;
}

std::string EncodeCollection(const std::vector<Digest>& digests) {
  std::string bytes;
  bytes.reserve(digests.size() * sizeof(Digest::bytes));
  for (const Digest& digest : digests) bytes.append(digest.bytes.begin(), digest.bytes.end());
  return bytes;
}

absl::StatusOr<std::vector<Digest>> DecodeCollection(std::string_view bytes) {
  constexpr size_t kSize = sizeof(Digest::bytes);
  if (bytes.size() % kSize != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("a collection of ", bytes.size(), " bytes is no list of digests"));
  }
  std::vector<Digest> digests(bytes.size() / kSize);
  for (size_t i = 0; i < digests.size(); ++i) {
    const std::string_view digest = bytes.substr(i * kSize, kSize);
    std::copy(digest.begin(), digest.end(), digests[i].bytes.begin());
  }
  return digests;
}

}  // namespace orbweave
