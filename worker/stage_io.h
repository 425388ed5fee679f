// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/status.h"
#include "core/merging/submodel.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/job_plan.h"
#include "core/pipeline/task.h"
#include "core/stages/pipeline_options.h"

/// What every stage adapter does with its inputs and outputs.

namespace orbweave {

/// Input number `index` of a task, decoded. InvalidArgument when the task has too few.
template <typename Decode>
auto FetchInput(const TaskSpec& spec, size_t index, BlobAccess& blobs, Decode decode)
    -> decltype(decode(std::string_view())) {
  if (index >= spec.inputs.size())
    return absl::InvalidArgumentError(spec.stage + ": too few inputs");
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, blobs.Get(spec.inputs[index]));
  return decode(bytes);
}

template <typename Decode>
auto FetchBlob(const Digest& digest, BlobAccess& blobs, Decode decode)
    -> decltype(decode(std::string_view())) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, blobs.Get(digest));
  return decode(bytes);
}

inline absl::StatusOr<PipelineOptions> OptionsOf(const TaskSpec& spec) {
  return PipelineOptionsFromText(spec.options_text, spec.stage);
}

inline absl::Status PutOutput(std::string_view bytes, BlobAccess& blobs, TaskResult& result) {
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, blobs.Put(bytes));
  result.outputs.push_back(digest);
  return absl::OkStatus();
}

template <typename Recipes, typename Encode>
absl::Status PutRecipes(const Recipes& recipes,
                        Encode encode,
                        BlobAccess& blobs,
                        TaskResult& result) {
  for (const auto& recipe : recipes) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, blobs.Put(encode(recipe)));
    result.recipes.push_back(digest);
  }
  return absl::OkStatus();
}

/// The collection of extract_features alternates Features and PlaceSample; these are its two
/// halves.
struct ExtractedBlobs {
  std::vector<Digest> features{};
  std::vector<Digest> places{};
};
absl::StatusOr<ExtractedBlobs> SplitExtracted(std::string_view collection);

/// The submodels that rims of clusters hold, by cluster and then by size.
absl::StatusOr<std::vector<Submodel>> LoadRims(std::span<const Digest> rims, BlobAccess& blobs);

}  // namespace orbweave
