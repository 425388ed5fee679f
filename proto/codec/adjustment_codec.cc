// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/adjustment_codec.h"

#include <utility>

#include "orbweave/v1/adjustment.pb.h"
#include "proto/codec/adjustment_messages.h"
#include "proto/codec/pack.h"
#include "proto/codec/reconstruction_messages.h"

namespace orbweave {
namespace {

void ToProto(const StepControl& control, v1::StepControl* proto) {
  proto->set_lambda(control.lambda);
  proto->set_is_bent(control.is_bent);
}

StepControl FromProto(const v1::StepControl& proto) { return {proto.lambda(), proto.is_bent()}; }

void ToProto(const GlobalAdjustReport& report, v1::AdjustmentReport* proto) {
  codec::ToProto(report.gnss, proto->mutable_gnss());
  for (const BundleReport& adjustment : report.adjustments)
    codec::ToProto(adjustment, proto->add_adjustments());
  for (const std::vector<double>& costs : report.accepted_costs)
    proto->add_accepted_costs(codec::Pack(costs));
  proto->set_bytes_of_block(codec::Pack(report.bytes_of_block));
  proto->set_num_observations(report.num_observations);
  proto->set_removed_observations(report.removed_observations);
  proto->set_removed_tracks(report.removed_tracks);
  for (const std::string& name : report.unobserved_images) proto->add_unobserved_images(name);
  proto->set_residual_px_mean(report.residual_px_mean);
  proto->set_residual_px_rms(report.residual_px_rms);
  proto->set_pattern_px(report.pattern_px);
  codec::ToProto(report.uncertainty, proto->mutable_uncertainty());
  for (const CrossCheck& check : report.checks) codec::ToProto(check, proto->add_checks());
  for (const Exclusion& image : report.weak_images) {
    v1::Exclusion* out = proto->add_weak_images();
    out->set_name(image.name);
    out->set_reason(image.reason);
  }
}

absl::Status FromProto(const v1::AdjustmentReport& proto, GlobalAdjustReport& report) {
  report.gnss = codec::FromProto(proto.gnss());
  report.uncertainty = codec::FromProto(proto.uncertainty());
  report.num_observations = proto.num_observations();
  report.removed_observations = proto.removed_observations();
  report.removed_tracks = proto.removed_tracks();
  report.unobserved_images.assign(proto.unobserved_images().begin(),
                                  proto.unobserved_images().end());
  report.residual_px_mean = proto.residual_px_mean();
  report.residual_px_rms = proto.residual_px_rms();
  report.pattern_px = proto.pattern_px();
  for (const v1::CrossCheck& check : proto.checks()) {
    ORBWEAVE_ASSIGN_OR_RETURN(CrossCheck decoded, codec::FromProto(check));
    report.checks.push_back(std::move(decoded));
  }
  for (const v1::Exclusion& image : proto.weak_images())
    report.weak_images.push_back({image.name(), image.reason()});
  for (const v1::BundleReport& adjustment : proto.adjustments()) {
    ORBWEAVE_ASSIGN_OR_RETURN(BundleReport decoded, codec::FromProto(adjustment));
    report.adjustments.push_back(std::move(decoded));
  }
  for (const std::string& bytes : proto.accepted_costs()) {
    ORBWEAVE_ASSIGN_OR_RETURN(auto costs, codec::Unpack<double>(bytes, "accepted costs"));
    report.accepted_costs.push_back(std::move(costs));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(report.bytes_of_block,
                            codec::Unpack<uint64_t>(proto.bytes_of_block(), "bytes of blocks"));
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

SeamCertificate FromProto(const v1::SeamCertificate& proto) {
  return {.cluster_a = proto.cluster_a(),
          .cluster_b = proto.cluster_b(),
          .num_images = proto.num_images(),
          .position_jump_m = proto.position_jump_m(),
          .rotation_jump_deg = proto.rotation_jump_deg(),
          .position_noise_m = proto.position_noise_m(),
          .rotation_noise_deg = proto.rotation_noise_deg()};
}

void ToProto(const WorldPath& path, v1::WorldPath* proto) {
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
  for (const std::vector<SeparatorId>& ids : path.path.separators_of_block)
    codec::ToProto(ids, proto->add_separators_of_block());
  ToProto(path.report, proto->mutable_report());
}

absl::StatusOr<BlockOrder::Work> WorkOf(uint32_t number) {
  if (number > static_cast<uint32_t>(BlockOrder::Work::kFilter))
    return absl::InvalidArgumentError("block order: unknown work");
  return static_cast<BlockOrder::Work>(number);
}

absl::StatusOr<WorldPath> FromProto(const v1::WorldPath& proto) {
  WorldPath path{.phase = proto.phase(),
                 .is_done = proto.is_done(),
                 .path = {.steps = {.control = FromProto(proto.control()),
                                    .growth = proto.growth(),
                                    .cost = proto.cost(),
                                    .iterations = proto.iterations(),
                                    .converged = proto.converged(),
                                    .accepted = proto.accepted()},
                          .separators_decrease = proto.separators_decrease()}};
  ORBWEAVE_ASSIGN_OR_RETURN(path.asked, WorkOf(proto.asked()));
  ORBWEAVE_ASSIGN_OR_RETURN(path.path.shortened, codec::FromProto(proto.shortened()));
  for (const v1::SeparatorIds& ids : proto.separators_of_block()) {
    ORBWEAVE_ASSIGN_OR_RETURN(auto separators, codec::FromProto(ids));
    path.path.separators_of_block.push_back(std::move(separators));
  }
  ORBWEAVE_RETURN_IF_ERROR(FromProto(proto.report(), path.report));
  return path;
}

}  // namespace

std::string EncodeBlockTask(const BlockTask& task) {
  v1::BlockTask proto;
  proto.set_block(codec::PackDigest(task.block));
  proto.set_state(codec::PackDigest(task.state));
  const BlockOrder& order = task.order;
  proto.set_work(static_cast<uint32_t>(order.work));
  proto.set_takes_trial(order.takes_trial);
  codec::ToProto(order.shortened, proto.mutable_shortened());
  ToProto(order.control, proto.mutable_control());
  codec::ToProto(order.step.variables, proto.mutable_step_variables());
  std::vector<std::array<double, 6>> steps;
  for (const Vector6& step : order.step.steps)
    steps.push_back({step[0], step[1], step[2], step[3], step[4], step[5]});
  proto.set_steps(codec::Pack(steps));
  proto.set_begins_again(order.begins_again);
  proto.set_loss(static_cast<uint32_t>(order.loss));
  return proto.SerializeAsString();
}

absl::StatusOr<BlockTask> DecodeBlockTask(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::BlockTask proto,
                            codec::Parse<v1::BlockTask>(bytes, "block task"));
  BlockTask task{.order = {.takes_trial = proto.takes_trial(),
                           .control = FromProto(proto.control()),
                           .begins_again = proto.begins_again()}};
  ORBWEAVE_ASSIGN_OR_RETURN(task.block, codec::UnpackDigest(proto.block()));
  ORBWEAVE_ASSIGN_OR_RETURN(task.state, codec::UnpackDigest(proto.state()));
  ORBWEAVE_ASSIGN_OR_RETURN(task.order.work, WorkOf(proto.work()));
  if (proto.loss() > static_cast<uint32_t>(BundleLoss::kHuber))
    return absl::InvalidArgumentError("block order: unknown loss");
  task.order.loss = static_cast<BundleLoss>(proto.loss());
  ORBWEAVE_ASSIGN_OR_RETURN(task.order.shortened, codec::FromProto(proto.shortened()));
  ORBWEAVE_ASSIGN_OR_RETURN(task.order.step.variables, codec::FromProto(proto.step_variables()));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto steps,
      (codec::UnpackExactly<std::array<double, 6>>(
          proto.steps(), task.order.step.variables.size(), "separator steps")));
  for (const auto& step : steps) task.order.step.steps.emplace_back(Vector6(step.data()));
  return task;
}

std::string EncodeBlockResult(const BlockResult& result) {
  v1::BlockResult proto;
  const BlockAnswer& answer = result.answer;
  codec::ToProto(answer.separators, proto.mutable_separators());
  proto.set_cost(answer.cost);
  proto.set_num_observations(answer.num_observations);
  codec::ToProto(answer.system, proto.mutable_system());
  codec::ToProto(answer.trial, proto.mutable_trial());
  proto.set_removed_observations(answer.removed_observations);
  proto.set_removed_tracks(answer.removed_tracks);
  codec::ToProto(answer.summary, proto.mutable_summary());
  proto.set_block(codec::PackDigest(result.block));
  proto.set_state(codec::PackDigest(result.state));
  proto.set_inspection(codec::PackDigest(result.inspection));
  return proto.SerializeAsString();
}

absl::StatusOr<BlockResult> DecodeBlockResult(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::BlockResult proto,
                            codec::Parse<v1::BlockResult>(bytes, "block result"));
  BlockResult result{.answer = {.cost = proto.cost(),
                                .num_observations = proto.num_observations(),
                                .removed_observations = proto.removed_observations(),
                                .removed_tracks = proto.removed_tracks()}};
  ORBWEAVE_ASSIGN_OR_RETURN(result.answer.separators, codec::FromProto(proto.separators()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.answer.system, codec::FromProto(proto.system()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.answer.trial, codec::FromProto(proto.trial()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.answer.summary, codec::FromProto(proto.summary()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.block, codec::UnpackDigest(proto.block()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.state, codec::UnpackDigest(proto.state()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.inspection, codec::UnpackDigest(proto.inspection()));
  return result;
}

std::string EncodeAdjustmentProgress(const AdjustmentProgress& progress) {
  v1::AdjustmentProgress proto;
  for (size_t world = 0; world < progress.worlds.size(); ++world) {
    v1::WorldPath* out = proto.add_worlds();
    ToProto(progress.worlds[world], out);
    out->set_is_asked(progress.is_asked[world] != 0);
  }
  for (const BlockPlace& place : progress.blocks) {
    v1::BlockPlace* out = proto.add_blocks();
    out->set_world(place.world);
    out->set_block(codec::PackDigest(place.block));
    out->set_state(codec::PackDigest(place.state));
    out->set_trial(codec::PackDigest(place.trial));
    codec::ToProto(place.summary, out->mutable_summary());
    out->set_inspection(codec::PackDigest(place.inspection));
  }
  return proto.SerializeAsString();
}

absl::StatusOr<AdjustmentProgress> DecodeAdjustmentProgress(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::AdjustmentProgress proto,
                            codec::Parse<v1::AdjustmentProgress>(bytes, "adjustment progress"));
  AdjustmentProgress progress;
  for (const v1::WorldPath& world : proto.worlds()) {
    ORBWEAVE_ASSIGN_OR_RETURN(WorldPath path, FromProto(world));
    progress.worlds.push_back(std::move(path));
    progress.is_asked.push_back(world.is_asked() ? 1 : 0);
  }
  for (const v1::BlockPlace& block : proto.blocks()) {
    BlockPlace& place = progress.blocks.emplace_back();
    place.world = block.world();
    if (place.world >= progress.worlds.size())
      return absl::InvalidArgumentError("adjustment progress: a block of no world");
    ORBWEAVE_ASSIGN_OR_RETURN(place.block, codec::UnpackDigest(block.block()));
    ORBWEAVE_ASSIGN_OR_RETURN(place.state, codec::UnpackDigest(block.state()));
    ORBWEAVE_ASSIGN_OR_RETURN(place.trial, codec::UnpackDigest(block.trial()));
    ORBWEAVE_ASSIGN_OR_RETURN(place.summary, codec::FromProto(block.summary()));
    ORBWEAVE_ASSIGN_OR_RETURN(place.inspection, codec::UnpackDigest(block.inspection()));
  }
  return progress;
}

std::string EncodeConcludedModel(const ConcludedModel& model) {
  v1::ConcludedModel proto;
  for (size_t world = 0; world < model.worlds.size(); ++world) {
    v1::ConcludedWorld* out = proto.add_worlds();
    codec::ToProto(model.worlds[world].model_from_world, out->mutable_model_from_world());
    codec::ToProto(Reconstruction{.images = model.worlds[world].images}, out->mutable_poses());
    ToProto(model.worlds[world].report, out->mutable_report());
    for (const Digest& block : model.blocks[world]) out->add_blocks(codec::PackDigest(block));
    for (const SeamCertificate& seam : model.worlds[world].seams) ToProto(seam, out->add_seams());
  }
  return proto.SerializeAsString();
}

absl::StatusOr<ConcludedModel> DecodeConcludedModel(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::ConcludedModel proto,
                            codec::Parse<v1::ConcludedModel>(bytes, "concluded model"));
  ConcludedModel model;
  for (const v1::ConcludedWorld& world : proto.worlds()) {
    ConcludedWorld& out = model.worlds.emplace_back();
    ORBWEAVE_ASSIGN_OR_RETURN(out.model_from_world, codec::FromProto(world.model_from_world()));
    ORBWEAVE_ASSIGN_OR_RETURN(Reconstruction poses, codec::FromProto(world.poses()));
    out.images = std::move(poses.images);
    ORBWEAVE_RETURN_IF_ERROR(FromProto(world.report(), out.report));
    std::vector<Digest>& blocks = model.blocks.emplace_back();
    for (const std::string& bytes_of_digest : world.blocks()) {
      ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, codec::UnpackDigest(bytes_of_digest));
      blocks.push_back(digest);
    }
    for (const v1::SeamCertificate& seam : world.seams()) out.seams.push_back(FromProto(seam));
  }
  return model;
}

}  // namespace orbweave
