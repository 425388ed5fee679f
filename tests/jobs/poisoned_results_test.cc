// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A worker leaves what it likes. A whole job, in one process, in which one result of one stage
// after the other is poisoned: a number that is none, an index of nothing, another part's result.
// Whatever it is, the job ends: with an error that says so, or with a model of numbers; never by a
// crash.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/report/check_results.h"
#include "orbweave/v1/adjustment.pb.h"
#include "orbweave/v1/artifacts.pb.h"
#include "stages/codecs.h"
#include "stages/conclude_adjustment/stage.h"
#include "stages/job_reader.h"
#include "stages/partition_view_graph/stage.h"
#include "stages/plans.h"
#include "stages/registry.h"
#include "stages/run_plan.h"
#include "tests/support/memory_blobs.h"
#include "tests/support/poison_message.h"
#include "tests/support/street_job.h"

namespace orbweave {
namespace {

using testing::MemoryBlobs;
using testing::Message;
using testing::MessagePoisoner;

/// A blob that a task left, as a message.
struct LeftBlob {
  Digest digest{};
  std::unique_ptr<Message> message{};
};

template <typename Proto>
LeftBlob Left(const Digest& digest) {
  return {digest, std::make_unique<Proto>()};
}

/// What an adjusted block names beside its reply.
void AddBulkOf(const TaskResult& result, BlobAccess& blobs, std::vector<LeftBlob>& left) {
  const auto reply = FetchBlob<SubproblemResult>(result.outputs[0], blobs).value();
  if (!reply.subproblem.IsZero()) left.push_back(Left<v1::Subproblem>(reply.subproblem));
  if (!reply.state.IsZero()) left.push_back(Left<v1::SubproblemState>(reply.state));
  if (!reply.inspection.IsZero()) left.push_back(Left<v1::SubproblemInspection>(reply.inspection));
}

/// All that a task left, but lists.
std::vector<LeftBlob> BlobsOf(const std::string& stage,
                              const TaskResult& result,
                              BlobAccess& blobs) {
  std::vector<LeftBlob> left;
  const auto outputs = [&](auto make) { left.push_back(make(result.outputs[0])); };
  const auto recipes = [&](auto make) {
    if (!result.recipes.empty()) left.push_back(make(result.recipes.front()));
  };
  if (stage == "verify_matches") outputs(Left<v1::TwoViewGeometries>);
  if (stage == "partition_view_graph") outputs(Left<v1::Partition>);
  if (stage == "partition_view_graph") recipes(Left<v1::ClusterRecipe>);
  if (stage == "reconstruct_cluster") {
    for (const Digest& digest : result.outputs)
      left.push_back(Left<v1::ClusterReconstruction>(digest));
  }
  if (stage == "fit_seams") outputs(Left<v1::SeamsOfCluster>);
  if (stage == "align_submodels") outputs(Left<v1::Alignment>);
  if (stage == "review_seams") outputs(Left<v1::PartitionReview>);
  if (stage == "join_submodels") outputs(Left<v1::JoinedWorlds>);
  if (stage == "join_submodels") recipes(Left<v1::AssembleRecipe>);
  if (stage == "assemble_block") outputs(Left<v1::Subproblem>);
  if (stage == "steer_adjustment") outputs(Left<v1::AdjustmentProgress>);
  if (stage == "steer_adjustment") recipes(Left<v1::SubproblemTask>);
  if (stage == "adjust_block") outputs(Left<v1::SubproblemResult>);
  if (stage == "adjust_block") AddBulkOf(result, blobs, left);
  if (stage == "conclude_adjustment") outputs(Left<v1::FinalisedModel>);
  return left;
}

/// Puts `bytes` where `result` names `old`, in what names it too.
void Replace(const Digest& old, const std::string& bytes, BlobAccess& blobs, TaskResult& result) {
  const Digest poisoned = blobs.Put(bytes).value();
  const auto name = [](const Digest& digest) {
    return std::string(digest.bytes.begin(), digest.bytes.end());
  };
  for (Digest& output : result.outputs) {
    std::string naming = blobs.Get(output).value();
    const size_t at = naming.find(name(old));
    if (output == old) {
      output = poisoned;
    } else if (at != std::string::npos) {
      output = blobs.Put(naming.replace(at, old.bytes.size(), name(poisoned))).value();
    }
  }
  std::ranges::replace(result.recipes, old, poisoned);
}

/// Which task's result is poisoned, and which of its numbers.
struct Poison {
  std::string stage{};
  size_t call = 0;  ///< of the stage, from 0
  size_t seed = 0;
};

/// The stages of this build, one of whose results is poisoned. What a task left before is left
/// again: tasks are what their names say.
class Workers {
 public:
  explicit Workers(BlobAccess& blobs) : blobs_(blobs) {}

  /// Runs the job; `poison`: nothing for a job without.
  absl::StatusOr<std::vector<TaskOutcome>> Run(const JobSpec& job, std::optional<Poison> poison) {
    poison_ = std::move(poison);
    calls_.clear();
    what_.clear();
    const StageLookup lookup = [this](std::string_view stage) { return Find(std::string(stage)); };
    return RunPlan(FindJobPlan(job.kind).value(), job, lookup, blobs_, {});
  }

  [[nodiscard]] const std::map<std::string, size_t>& calls() const { return calls_; }
  /// What was done to the result; empty: nothing.
  [[nodiscard]] const std::string& what() const { return what_; }

 private:
  const StageFunction* Find(const std::string& stage) {
    StageFunction& function = functions_[stage];
    if (!function) {
      function = [this, stage](const TaskSpec& spec,
                               BlobAccess& blobs,
                               const StageContext& context) -> absl::StatusOr<TaskResult> {
        ORBWEAVE_ASSIGN_OR_RETURN(TaskResult result, RunOrRemember(stage, spec, blobs, context));
        const size_t call = calls_[stage]++;
        if (poison_ && poison_->stage == stage && poison_->call == call) Spoil(result);
        last_[stage] = result;
        return result;
      };
    }
    return &function;
  }

  absl::StatusOr<TaskResult> RunOrRemember(const std::string& stage,
                                           const TaskSpec& spec,
                                           BlobAccess& blobs,
                                           const StageContext& context) {
    const auto known = known_.find(spec.Id());
    if (known != known_.end()) return known->second;
    ORBWEAVE_ASSIGN_OR_RETURN(TaskResult result, (*FindStageFunction(stage))(spec, blobs, context));
    known_[spec.Id()] = result;
    return result;
  }

  void Spoil(TaskResult& result) {
    Random random(poison_->seed);
    if (random.Index(8) == 0 && last_.contains(poison_->stage)) {
      what_ = "the result of the part before";
      result = last_[poison_->stage];
      return;
    }
    std::vector<LeftBlob> left = BlobsOf(poison_->stage, result, blobs_);
    if (left.empty()) return;
    const LeftBlob& blob = left[random.Index(left.size())];
    if (!blob.message->ParseFromString(blobs_.Get(blob.digest).value())) return;
    std::vector<std::pair<std::string, std::string>> poisoned;
    MessagePoisoner poisoner(
        [&](const std::string& field, const std::string& number, bool) {
          if (random.Index(++seen_) == 0) chosen_ = {field + " = " + number, Bytes(*blob.message)};
        },
        2);
    seen_ = 0;
    poisoner.Visit(*blob.message);
    if (seen_ == 0) return;
    what_ = chosen_.first;
    Replace(blob.digest, chosen_.second, blobs_, result);
  }

  static std::string Bytes(const Message& message) { return message.SerializeAsString(); }

  BlobAccess& blobs_;
  std::optional<Poison> poison_{};
  std::string what_{};
  size_t seen_ = 0;
  std::pair<std::string, std::string> chosen_{};  ///< what, and the bytes with it
  std::map<std::string, StageFunction> functions_{};
  std::map<std::string, size_t> calls_{};
  std::map<std::string, TaskResult> last_{};
  std::map<Digest, TaskResult> known_{};
};

/// Whoever writes outputs reads the model like this.
absl::Status ReadModel(const JobSpec& job,
                       const std::vector<TaskOutcome>& outcomes,
                       BlobAccess& blobs) {
  const JobPlan plan = FindJobPlan(job.kind).value();
  JobReader reader(plan, job, outcomes, blobs);
  ORBWEAVE_ASSIGN_OR_RETURN(const auto manifest, reader.Read(&PartitionViewGraphStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto model,
                            reader.Read(&ConcludeAdjustmentStage::Outputs::model));
  for (size_t world = 0; world < model.worlds.size(); ++world) {
    const auto images = ModelImages(model.worlds[world]);
    ORBWEAVE_RETURN_IF_ERROR(CheckModel(images, manifest));
    TracksOfWorld tracks(model.worlds[world]);
    const auto visit = [](const Track& track) {
      EXPECT_TRUE(track.point_in_world.allFinite());
      for (const Observation& seen : track.observations) EXPECT_TRUE(seen.bearing.allFinite());
    };
    for (const Digest& digest : model.subproblems[world]) {
      ORBWEAVE_ASSIGN_OR_RETURN(Subproblem subproblem, reader.Fetch<Subproblem>(digest));
      tracks.Add(std::move(subproblem), visit);
    }
    tracks.Finish(visit);
    for (const auto& [id, image] : images)
      EXPECT_TRUE(image.cam_from_world.Centre().allFinite()) << id.value;
  }
  return absl::OkStatus();
}

/// What a street is made and adjusted by.
struct Street {
  std::string name{};
  int drives = 1;
  std::vector<std::string> options{};
};

class PoisonedResults : public ::testing::TestWithParam<Street> {
 protected:
  static constexpr size_t kPoisonsPerStage = 30;

  void SetUp() override {
    std::vector<std::string> options = GetParam().options;
    options.insert(options.end(), {"partition.cluster_size=6", "partition.overlap=4"});
    job_ = testing::StreetJob(
        {.panoramas = 18, .features_per_panorama = 60, .drives = GetParam().drives},
        options,
        blobs_);
    const auto clean = workers_.Run(job_, std::nullopt);
    ASSERT_TRUE(clean.ok()) << clean.status();
    ASSERT_TRUE(ReadModel(job_, *clean, blobs_).ok());
  }

  MemoryBlobs blobs_;
  JobSpec job_{};
  Workers workers_{blobs_};
};

TEST_P(PoisonedResults, EndAJobWithAnErrorOrAModelOfNumbers) {
  const std::map<std::string, size_t> calls = workers_.calls();
  ASSERT_GE(calls.size(), 10U);
  size_t poisoned = 0;
  size_t refused = 0;
  Random random(11);
  for (const auto& [stage, count] : calls) {
    for (size_t i = 0; i < kPoisonsPerStage; ++i) {
      const Poison poison{stage, random.Index(count), random.Index(1U << 30U)};
      const auto outcomes = workers_.Run(job_, poison);
      if (workers_.what().empty()) continue;
      SCOPED_TRACE(stage + ", call " + std::to_string(poison.call) + ": " + workers_.what());
      const absl::Status end =
          outcomes.ok() ? ReadModel(job_, *outcomes, blobs_) : outcomes.status();
      ++poisoned;
      refused += end.ok() ? 0 : 1;
      EXPECT_NE(end.code(), absl::StatusCode::kInternal) << end;
    }
  }
  EXPECT_GT(poisoned, 200U);
  EXPECT_GT(refused, poisoned / 2);
}

INSTANTIATE_TEST_SUITE_P(Streets,
                         PoisonedResults,
                         ::testing::Values(Street{"of_two_drives", 2, {"blocks.distribute_from=2"}},
                                           Street{"without_positions",
                                                  1,
                                                  {"blocks.distribute_from=2", "global.gnss=off"}},
                                           Street{"adjusted_in_one_process", 1, {}}),
                         [](const auto& street) { return street.param.name; });

}  // namespace
}  // namespace orbweave
