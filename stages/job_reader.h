// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/pipeline/blob_access.h"
#include "core/pipeline/coordinator_api.h"
#include "core/pipeline/job_plan.h"
#include "stages/stage_task.h"

namespace orbweave {

/// The outputs of a stage, as against its inputs.
template <typename T>
concept LeftByStage = requires {
  typename T::Stage;
};

/// Reads what a job has left so far, by the ports of its stages. A port that a stage reads stands
/// for what the plan wires it to, whatever kind of job that is: an input of the job, or what
/// another stage left. What it is given outlives it. Errors of all: NotFound where the job has not
/// come so far; those of the blobs; of codecs when bytes are not what they should be.
class JobReader {
 public:
  JobReader(const JobPlan& plan,
            const JobSpec& job,
            const std::vector<TaskOutcome>& outcomes,
            BlobAccess& blobs)
      : plan_(plan), job_(job), outcomes_(outcomes), blobs_(blobs) {}

  /// What the only part of a stage left: Read(&AlignSubmodelsStage::Outputs::alignment).
  template <typename T, LeftByStage Outputs>
  [[nodiscard]] absl::StatusOr<T> Read(One<T> Outputs::*port) {
    return ReadFrom<T>(
        {InputRule::Kind::kOutput, NameOf<typename Outputs::Stage>(), IndexOf(port, false)});
  }
  /// What a stage reads, by its wiring: Read(&PartitionViewGraphStage::manifest).
  template <typename T, typename Stage>
  requires(!LeftByStage<Stage>) [[nodiscard]] absl::StatusOr<T> Read(One<T> Stage::*port) {
    ORBWEAVE_ASSIGN_OR_RETURN(const InputRule from, WiringOf(port));
    return ReadFrom<T>(from);
  }

  /// Its name only: of what the only part of a stage left, or of what a stage reads.
  template <typename T, LeftByStage Outputs>
  [[nodiscard]] absl::StatusOr<Digest> Name(One<T> Outputs::*port) const {
    return DigestFrom(
        {InputRule::Kind::kOutput, NameOf<typename Outputs::Stage>(), IndexOf(port, false)});
  }
  template <typename T, typename Stage>
  requires(!LeftByStage<Stage>)
      [[nodiscard]] absl::StatusOr<Digest> Name(One<T> Stage::*port) const {
    ORBWEAVE_ASSIGN_OR_RETURN(const InputRule from, WiringOf(port));
    return DigestFrom(from);
  }

  /// Digests of what each part of a stage left that is done.
  template <typename T, LeftByStage Outputs>
  [[nodiscard]] absl::StatusOr<std::vector<Digest>> List(EachPart<T> Outputs::*port) {
    return ListFrom(
        {InputRule::Kind::kCollection, NameOf<typename Outputs::Stage>(), IndexOf(port, false)});
  }
  template <typename T, typename Stage>
  requires(!LeftByStage<Stage>)
      [[nodiscard]] absl::StatusOr<std::vector<Digest>> List(EachPart<T> Stage::*port) {
    ORBWEAVE_ASSIGN_OR_RETURN(const InputRule from, WiringOf(port));
    return ListFrom(from);
  }
  template <typename A, typename B, typename Stage>
  [[nodiscard]] absl::StatusOr<InterleavedDigests> List(Interleaved<A, B> Stage::*port) {
    ORBWEAVE_ASSIGN_OR_RETURN(const InputRule from, WiringOf(port));
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> digests, ListFrom(from));
    return SplitInterleaved(digests);
  }

  /// Recipes of the stage that leaves what comes in by this port; none while nobody listed them.
  template <typename T, typename Stage>
  [[nodiscard]] absl::StatusOr<std::vector<Digest>> RecipesBehind(EachPart<T> Stage::*port) {
    ORBWEAVE_ASSIGN_OR_RETURN(const InputRule from, WiringOf(port));
    return RecipesOf(from.stage);
  }

  /// What a blob holds that is named in another one.
  template <typename T>
  [[nodiscard]] absl::StatusOr<T> Fetch(const Digest& digest) {
    return FetchBlob<T>(digest, blobs_);
  }

  /// The reports of the parts of a stage that are done, in part order.
  template <typename Stage>
  [[nodiscard]] std::vector<std::string> Reports() const {
    std::vector<std::string> reports;
    for (const TaskOutcome* outcome : OutcomesOf(Stage::kFacts.name))
      reports.push_back(outcome->result.report_json);
    return reports;
  }

 private:
  template <typename Stage>
  static std::string NameOf() {
    return std::string(Stage::kFacts.name);
  }
  template <typename Port, typename Stage>
  [[nodiscard]] absl::StatusOr<InputRule> WiringOf(Port Stage::*port) const {
    return WiringOf(Stage::kFacts.name, IndexOf(port, true));
  }
  template <typename T>
  [[nodiscard]] absl::StatusOr<T> ReadFrom(const InputRule& from) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, DigestFrom(from));
    return FetchBlob<T>(digest, blobs_);
  }

  [[nodiscard]] absl::StatusOr<InputRule> WiringOf(std::string_view stage, uint32_t input) const;
  [[nodiscard]] absl::StatusOr<Digest> DigestFrom(const InputRule& from) const;
  [[nodiscard]] absl::StatusOr<std::vector<Digest>> ListFrom(const InputRule& from);
  [[nodiscard]] absl::StatusOr<std::vector<Digest>> RecipesOf(std::string_view stage);
  [[nodiscard]] std::vector<const TaskOutcome*> OutcomesOf(std::string_view stage) const;

  const JobPlan& plan_;
  const JobSpec& job_;
  const std::vector<TaskOutcome>& outcomes_;
  BlobAccess& blobs_;
};

}  // namespace orbweave
