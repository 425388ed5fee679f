// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/adjustment_codec.h"

#include <algorithm>
#include <utility>

#include "orbweave/v1/adjustment.pb.h"
#include "proto/codec/adjustment_messages.h"
#include "proto/codec/exclusion_messages.h"
#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"
#include "proto/codec/reconstruction_messages.h"

namespace orbweave {
namespace {

void ToProto(const StepControl& control, v1::StepControl* proto) {
  proto->set_lambda(control.lambda);
  proto->set_is_bent(control.is_bent);
}

absl::StatusOr<StepControl> FromProto(const v1::StepControl& proto) {
  if (!(proto.lambda() > 0.0) || !codec::IsNumber(proto.lambda()))
    return absl::DataLossError("adjustment: a damping that is none");
  return StepControl{proto.lambda(), proto.is_bent()};
}

void ToProto(const GlobalAdjustReport& report, v1::AdjustmentReport* proto) {
  codec::ToProto(report.gnss, proto->mutable_gnss());
  for (const BundleReport& adjustment : report.adjustments)
    codec::ToProto(adjustment, proto->add_adjustments());
  for (const std::vector<double>& costs : report.accepted_costs)
    proto->add_accepted_costs(codec::Pack(costs));
  proto->set_bytes_of_subproblem(codec::Pack(report.bytes_of_subproblem));
  proto->set_num_observations(report.num_observations);
  proto->set_removed_observations(report.removed_observations);
  proto->set_removed_tracks(report.removed_tracks);
  proto->set_residual_px_mean(report.residual_px_mean);
  proto->set_residual_px_rms(report.residual_px_rms);
  proto->set_pattern_px(report.pattern_px);
  codec::ToProto(report.uncertainty, proto->mutable_uncertainty());
  for (const CrossCheck& check : report.checks) codec::ToProto(check, proto->add_checks());
  codec::ToProto(report.weak_images, proto->mutable_weak_images());
}

absl::Status FromProto(const v1::AdjustmentReport& proto, GlobalAdjustReport& report) {
  ORBWEAVE_ASSIGN_OR_RETURN(report.gnss, codec::FromProto(proto.gnss()));
  ORBWEAVE_ASSIGN_OR_RETURN(report.uncertainty, codec::FromProto(proto.uncertainty()));
  report.num_observations = proto.num_observations();
  report.removed_observations = proto.removed_observations();
  report.removed_tracks = proto.removed_tracks();
  report.residual_px_mean = proto.residual_px_mean();
  report.residual_px_rms = proto.residual_px_rms();
  report.pattern_px = proto.pattern_px();
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(codec::IsAmount(report.residual_px_mean) &&
                                             codec::IsAmount(report.residual_px_rms) &&
                                             codec::IsAmount(report.pattern_px),
                                         "adjustment report",
                                         "a residual is none"));
  for (const v1::CrossCheck& check : proto.checks()) {
    ORBWEAVE_ASSIGN_OR_RETURN(CrossCheck decoded, codec::FromProto(check));
    report.checks.push_back(std::move(decoded));
  }
  report.weak_images = codec::FromProto(proto.weak_images());
  for (const v1::BundleReport& adjustment : proto.adjustments()) {
    ORBWEAVE_ASSIGN_OR_RETURN(BundleReport decoded, codec::FromProto(adjustment));
    report.adjustments.push_back(std::move(decoded));
  }
  for (const std::string& bytes : proto.accepted_costs()) {
    ORBWEAVE_ASSIGN_OR_RETURN(auto costs, codec::Unpack<double>(bytes, "accepted costs"));
    ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
        std::ranges::all_of(costs, codec::IsAmount), "adjustment report", "a cost is none"));
    report.accepted_costs.push_back(std::move(costs));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(
      report.bytes_of_subproblem,
      codec::Unpack<uint64_t>(proto.bytes_of_subproblem(), "bytes of blocks"));
  return absl::OkStatus();
}

void ToProto(const SeamCertificate& seam, v1::SeamCertificate* proto) {
  proto->set_cluster_a(seam.cluster_a);
  proto->set_cluster_b(seam.cluster_b);
  proto->set_num_images(seam.num_images);
  proto->set_position_jump_m(seam.position_jump_m);
  proto->set_rotation_jump_deg(seam.rotation_jump_deg);
  proto->set_position_noise_m(seam.position_noise_m);
  proto->set_rotation_noise_deg(seam.rotation_noise_deg);
}

absl::StatusOr<SeamCertificate> FromProto(const v1::SeamCertificate& proto) {
  const SeamCertificate seam{.cluster_a = proto.cluster_a(),
                             .cluster_b = proto.cluster_b(),
                             .num_images = proto.num_images(),
                             .position_jump_m = proto.position_jump_m(),
                             .rotation_jump_deg = proto.rotation_jump_deg(),
                             .position_noise_m = proto.position_noise_m(),
                             .rotation_noise_deg = proto.rotation_noise_deg()};
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      seam.cluster_a < seam.cluster_b, "concluded model", "a seam is not between two clusters"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      codec::IsAmount(seam.position_jump_m) && codec::IsAmount(seam.rotation_jump_deg) &&
          codec::IsAmount(seam.position_noise_m) && codec::IsAmount(seam.rotation_noise_deg),
      "concluded model",
      "the jump of a seam is none"));
  return seam;
}

/// Steps and phases are counted up to what options allow, each at most a few times.
bool IsCount(int count) { return count >= 0 && count <= 1'000'000; }

absl::Status CheckProgress(const WorldProgress& world) {
  const LevenbergMarquardt& steps = world.path.steps;
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      IsCount(world.phase) && IsCount(steps.iterations), "adjustment progress", "a count is none"));
  return codec::Expect(steps.growth > 0.0 && codec::IsNumber(steps.growth) &&
                           codec::IsAmount(steps.cost) &&
                           codec::IsNumber(world.path.separators_decrease),
                       "adjustment progress",
                       "a cost is none");
}

void ToProto(const WorldProgress& path, v1::WorldProgress* proto) {
  proto->set_phase(path.phase);
  proto->set_asked(static_cast<uint32_t>(path.asked));
  proto->set_is_done(path.is_done);
  ToProto(path.path.steps.control, proto->mutable_control());
  proto->set_growth(path.path.steps.growth);
  proto->set_cost(path.path.steps.cost);
  proto->set_iterations(path.path.steps.iterations);
  proto->set_converged(path.path.steps.converged);
  proto->set_accepted(path.path.steps.accepted);
  proto->set_separators_decrease(path.path.separators_decrease);
  codec::ToProto(path.path.shortened, proto->mutable_shortened());
  for (const std::vector<SeparatorId>& ids : path.path.separators_of_subproblem)
    codec::ToProto(ids, proto->add_separators_of_subproblem());
  ToProto(path.report, proto->mutable_report());
}

absl::StatusOr<LmRequest::Work> WorkOf(uint32_t number) {
  if (number > static_cast<uint32_t>(LmRequest::Work::kFilter))
    return absl::DataLossError("block order: unknown work");
  return static_cast<LmRequest::Work>(number);
}

absl::StatusOr<WorldProgress> FromProto(const v1::WorldProgress& proto) {
  WorldProgress path{.phase = proto.phase(),
                     .is_done = proto.is_done(),
                     .path = {.steps = {.growth = proto.growth(),
                                        .cost = proto.cost(),
                                        .iterations = proto.iterations(),
                                        .converged = proto.converged(),
                                        .accepted = proto.accepted()},
                              .separators_decrease = proto.separators_decrease()}};
  ORBWEAVE_ASSIGN_OR_RETURN(path.asked, WorkOf(proto.asked()));
  ORBWEAVE_ASSIGN_OR_RETURN(path.path.steps.control, FromProto(proto.control()));
  ORBWEAVE_RETURN_IF_ERROR(CheckProgress(path));
  ORBWEAVE_ASSIGN_OR_RETURN(path.path.shortened, codec::FromProto(proto.shortened()));
  for (const v1::SeparatorIds& ids : proto.separators_of_subproblem()) {
    ORBWEAVE_ASSIGN_OR_RETURN(auto separators, codec::FromProto(ids));
    path.path.separators_of_subproblem.push_back(std::move(separators));
  }
  ORBWEAVE_RETURN_IF_ERROR(FromProto(proto.report(), path.report));
  return path;
}

}  // namespace

absl::StatusOr<std::string> EncodeSubproblemTask(const SubproblemTask& task) {
  v1::SubproblemTask proto;
  proto.set_subproblem(codec::PackDigest(task.subproblem));
  proto.set_state(codec::PackDigest(task.state));
  const LmRequest& request = task.request;
  proto.set_work(static_cast<uint32_t>(request.work));
  proto.set_takes_trial(request.takes_trial);
  codec::ToProto(request.shortened, proto.mutable_shortened());
  ToProto(request.control, proto.mutable_control());
  codec::ToProto(request.step.variables, proto.mutable_step_variables());
  std::vector<std::array<double, 6>> steps;
  for (const Vector6& step : request.step.steps)
    steps.push_back({step[0], step[1], step[2], step[3], step[4], step[5]});
  proto.set_steps(codec::Pack(steps));
  proto.set_evaluates_again(request.evaluates_again);
  proto.set_loss(static_cast<uint32_t>(request.loss));
  return codec::Serialize(proto, "block task");
}

absl::StatusOr<SubproblemTask> DecodeSubproblemTask(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::SubproblemTask proto,
                            codec::Parse<v1::SubproblemTask>(bytes, "block task"));
  SubproblemTask task{
      .request = {.takes_trial = proto.takes_trial(), .evaluates_again = proto.evaluates_again()}};
  ORBWEAVE_ASSIGN_OR_RETURN(task.request.control, FromProto(proto.control()));
  ORBWEAVE_ASSIGN_OR_RETURN(task.subproblem, codec::UnpackDigest(proto.subproblem()));
  ORBWEAVE_ASSIGN_OR_RETURN(task.state, codec::UnpackDigest(proto.state()));
  ORBWEAVE_ASSIGN_OR_RETURN(task.request.work, WorkOf(proto.work()));
  if (proto.loss() > static_cast<uint32_t>(BundleLoss::kHuber))
    return absl::DataLossError("block order: unknown loss");
  task.request.loss = static_cast<BundleLoss>(proto.loss());
  ORBWEAVE_ASSIGN_OR_RETURN(task.request.shortened, codec::FromProto(proto.shortened()));
  ORBWEAVE_ASSIGN_OR_RETURN(task.request.step.variables, codec::FromProto(proto.step_variables()));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto steps,
      (codec::UnpackExactly<std::array<double, 6>>(
          proto.steps(), task.request.step.variables.size(), "separator steps")));
  for (const auto& step : steps) {
    task.request.step.steps.emplace_back(Vector6(step.data()));
    ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
        codec::AreNumbers(task.request.step.steps.back()), "block order", "a step is none"));
  }
  return task;
}

absl::StatusOr<std::string> EncodeSubproblemResult(const SubproblemResult& result) {
  v1::SubproblemResult proto;
  const LmReply& reply = result.reply;
  codec::ToProto(reply.separators, proto.mutable_separators());
  proto.set_cost(reply.cost);
  proto.set_num_observations(reply.num_observations);
  codec::ToProto(reply.system, proto.mutable_system());
  codec::ToProto(reply.trial, proto.mutable_trial());
  proto.set_removed_observations(reply.removed_observations);
  proto.set_removed_tracks(reply.removed_tracks);
  codec::ToProto(reply.summary, proto.mutable_summary());
  proto.set_subproblem(codec::PackDigest(result.subproblem));
  proto.set_state(codec::PackDigest(result.state));
  proto.set_inspection(codec::PackDigest(result.inspection));
  return codec::Serialize(proto, "block result");
}

absl::StatusOr<SubproblemResult> DecodeSubproblemResult(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::SubproblemResult proto,
                            codec::Parse<v1::SubproblemResult>(bytes, "block result"));
  SubproblemResult result{.reply = {.cost = proto.cost(),
                                    .num_observations = proto.num_observations(),
                                    .removed_observations = proto.removed_observations(),
                                    .removed_tracks = proto.removed_tracks()}};
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::IsAmount(proto.cost()), "block result", "a cost is none"));
  ORBWEAVE_ASSIGN_OR_RETURN(result.reply.separators, codec::FromProto(proto.separators()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.reply.system, codec::FromProto(proto.system()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.reply.trial, codec::FromProto(proto.trial()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.reply.summary, codec::FromProto(proto.summary()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.subproblem, codec::UnpackDigest(proto.subproblem()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.state, codec::UnpackDigest(proto.state()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.inspection, codec::UnpackDigest(proto.inspection()));
  return result;
}

absl::StatusOr<std::string> EncodeAdjustmentProgress(const AdjustmentProgress& progress) {
  v1::AdjustmentProgress proto;
  for (size_t world = 0; world < progress.worlds.size(); ++world) {
    v1::WorldProgress* out = proto.add_worlds();
    ToProto(progress.worlds[world], out);
    out->set_is_asked(progress.is_asked[world] != 0);
  }
  for (const SubproblemPlace& place : progress.subproblems) {
    v1::SubproblemPlace* out = proto.add_subproblems();
    out->set_world(place.world);
    out->set_subproblem(codec::PackDigest(place.subproblem));
    out->set_state(codec::PackDigest(place.state));
    out->set_trial(codec::PackDigest(place.trial));
    codec::ToProto(place.summary, out->mutable_summary());
    out->set_inspection(codec::PackDigest(place.inspection));
  }
  return codec::Serialize(proto, "adjustment progress", codec::Empty::kIsLegal);
}

absl::StatusOr<AdjustmentProgress> DecodeAdjustmentProgress(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::AdjustmentProgress proto,
      codec::Parse<v1::AdjustmentProgress>(bytes, "adjustment progress", codec::Empty::kIsLegal));
  AdjustmentProgress progress;
  for (const v1::WorldProgress& world : proto.worlds()) {
    ORBWEAVE_ASSIGN_OR_RETURN(WorldProgress path, FromProto(world));
    progress.worlds.push_back(std::move(path));
    progress.is_asked.push_back(world.is_asked() ? 1 : 0);
  }
  for (const v1::SubproblemPlace& subproblem : proto.subproblems()) {
    SubproblemPlace& place = progress.subproblems.emplace_back();
    place.world = subproblem.world();
    if (place.world >= progress.worlds.size())
      return absl::DataLossError("adjustment progress: a block of no world");
    ORBWEAVE_ASSIGN_OR_RETURN(place.subproblem, codec::UnpackDigest(subproblem.subproblem()));
    ORBWEAVE_ASSIGN_OR_RETURN(place.state, codec::UnpackDigest(subproblem.state()));
    ORBWEAVE_ASSIGN_OR_RETURN(place.trial, codec::UnpackDigest(subproblem.trial()));
    ORBWEAVE_ASSIGN_OR_RETURN(place.summary, codec::FromProto(subproblem.summary()));
    ORBWEAVE_ASSIGN_OR_RETURN(place.inspection, codec::UnpackDigest(subproblem.inspection()));
  }
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(std::ranges::is_sorted(progress.subproblems, {}, &SubproblemPlace::world),
                    "adjustment progress",
                    "blocks are not in order"));
  return progress;
}

absl::StatusOr<std::string> EncodeFinalisedModel(const FinalisedModel& model) {
  v1::FinalisedModel proto;
  for (size_t world = 0; world < model.worlds.size(); ++world) {
    v1::FinalisedWorld* out = proto.add_worlds();
    codec::ToProto(model.worlds[world].model_from_world, out->mutable_model_from_world());
    codec::ToProto(Reconstruction{.images = model.worlds[world].images}, out->mutable_poses());
    ToProto(model.worlds[world].report, out->mutable_report());
    for (const Digest& subproblem : model.subproblems[world])
      out->add_subproblems(codec::PackDigest(subproblem));
    for (const SeamCertificate& seam : model.worlds[world].seams) ToProto(seam, out->add_seams());
  }
  codec::ToProto(model.left_out, proto.mutable_left_out());
  return codec::Serialize(proto, "concluded model", codec::Empty::kIsLegal);
}

absl::StatusOr<FinalisedModel> DecodeFinalisedModel(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::FinalisedModel proto,
      codec::Parse<v1::FinalisedModel>(bytes, "concluded model", codec::Empty::kIsLegal));
  FinalisedModel model;
  for (const v1::FinalisedWorld& world : proto.worlds()) {
    FinalisedWorld& out = model.worlds.emplace_back();
    ORBWEAVE_ASSIGN_OR_RETURN(out.model_from_world,
                              codec::PlacementFromProto(world.model_from_world()));
    ORBWEAVE_ASSIGN_OR_RETURN(Reconstruction poses, codec::FromProto(world.poses()));
    out.images = std::move(poses.images);
    ORBWEAVE_RETURN_IF_ERROR(FromProto(world.report(), out.report));
    std::vector<Digest>& subproblems = model.subproblems.emplace_back();
    for (const std::string& bytes_of_digest : world.subproblems()) {
      ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, codec::UnpackDigest(bytes_of_digest));
      subproblems.push_back(digest);
    }
    for (const v1::SeamCertificate& seam : world.seams()) {
      ORBWEAVE_ASSIGN_OR_RETURN(out.seams.emplace_back(), FromProto(seam));
    }
  }
  model.left_out = codec::FromProto(proto.left_out());
  return model;
}

}  // namespace orbweave
