// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/subproblem_codec.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orbweave/v1/adjustment.pb.h"
#include "proto/codec/adjustment_messages.h"
#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"
#include "proto/codec/reconstruction_messages.h"

namespace orbweave {
namespace {

using codec::PoseBytes;
using codec::ToArray;
using codec::ToVector;
using codec::Vector3Bytes;

enum SubproblemImageFlag : uint8_t { kSeparator = 1, kHeld = 2 };

void ImagesToProto(const Subproblem& subproblem, v1::Subproblem* proto) {
  std::vector<std::array<int32_t, 2>> cameras;
  std::vector<uint8_t> flags;
  std::vector<uint32_t> owners;
  for (const SubproblemImage& image : subproblem.images) {
    cameras.push_back({image.camera.width_px, image.camera.height_px});
    flags.push_back(
        static_cast<uint8_t>((image.is_separator ? kSeparator : 0) | (image.is_held ? kHeld : 0)));
    owners.push_back(image.owner);
  }
  proto->set_cameras(codec::Pack(cameras));
  proto->set_flags(codec::Pack(flags));
  proto->set_owners(codec::Pack(owners));
}

absl::Status ImagesFromProto(const v1::Subproblem& proto, Subproblem& subproblem) {
  const size_t count = subproblem.scene.images.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto cameras,
      (codec::UnpackExactly<std::array<int32_t, 2>>(proto.cameras(), count, "cameras")));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto flags,
                            codec::UnpackExactly<uint8_t>(proto.flags(), count, "image flags"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto owners,
                            codec::UnpackExactly<uint32_t>(proto.owners(), count, "image owners"));
  const auto has_size = [](const std::array<int32_t, 2>& camera) {
    return codec::IsSize(camera[0]) && codec::IsSize(camera[1]);
  };
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(std::ranges::all_of(cameras, has_size), "world block", "a camera has no size"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      codec::AreFlags(flags, kSeparator | kHeld), "world block", "unknown flags of an image"));
  size_t i = 0;
  for (const auto& [id, image] : subproblem.scene.images) {
    subproblem.images.push_back({.id = id,
                                 .camera = {cameras[i][0], cameras[i][1]},
                                 .owner = owners[i],
                                 .is_separator = (flags[i] & kSeparator) != 0,
                                 .is_held = (flags[i] & kHeld) != 0});
    ++i;
  }
  return absl::OkStatus();
}

void SplitToProto(const Subproblem& subproblem, v1::Subproblem* proto) {
  if (subproblem.split.empty()) return;
  std::vector<uint32_t> ids;
  Reconstruction parts{.images = subproblem.scene.images};
  for (const SplitTrack& track : subproblem.split) {
    ids.push_back(track.id);
    parts.tracks.push_back(track.part);
  }
  proto->set_split_ids(codec::Pack(ids));
  codec::ToProto(parts, proto->mutable_split());
}

absl::Status SplitFromProto(const v1::Subproblem& proto, Subproblem& subproblem) {
  ORBWEAVE_ASSIGN_OR_RETURN(Reconstruction parts, codec::FromProto(proto.split()));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto ids,
      codec::UnpackExactly<uint32_t>(proto.split_ids(), parts.tracks.size(), "split tracks"));
  constexpr uint32_t kMostSplit = 0x7fffffffU;  // what is above names inner points
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::Ascends(ids) && (ids.empty() || ids.back() <= kMostSplit),
                    "world block",
                    "split tracks are not in order"));
  for (size_t i = 0; i < ids.size(); ++i)
    subproblem.split.push_back({ids[i], std::move(parts.tracks[i])});
  return absl::OkStatus();
}

void PriorsToProto(const Subproblem& subproblem, v1::Subproblem* proto) {
  std::vector<ImageId> images;
  std::vector<Vector3Bytes> positions;
  std::vector<Vector3Bytes> sigmas;
  std::vector<int32_t> groups;
  for (const SubproblemPrior& prior : subproblem.priors) {
    images.push_back(prior.image);
    positions.push_back(ToArray(prior.position_in_world));
    sigmas.push_back(ToArray(prior.sigma_m));
    groups.push_back(prior.bias_group ? static_cast<int32_t>(*prior.bias_group) : -1);
  }
  proto->set_prior_images(codec::Pack(images));
  proto->set_prior_positions(codec::Pack(positions));
  proto->set_prior_sigmas_m(codec::Pack(sigmas));
  proto->set_prior_groups(codec::Pack(groups));
}

absl::Status PriorsFromProto(const v1::Subproblem& proto, Subproblem& subproblem) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images,
                            codec::Unpack<ImageId>(proto.prior_images(), "priors"));
  const size_t count = images.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto positions,
      codec::UnpackExactly<Vector3Bytes>(proto.prior_positions(), count, "prior positions"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto sigmas,
      codec::UnpackExactly<Vector3Bytes>(proto.prior_sigmas_m(), count, "prior sigmas"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto groups,
      codec::UnpackExactly<int32_t>(proto.prior_groups(), count, "prior groups"));
  for (size_t i = 0; i < count; ++i) {
    SubproblemPrior prior{.image = images[i],
                          .position_in_world = ToVector(positions[i]),
                          .sigma_m = ToVector(sigmas[i])};
    if (groups[i] >= 0) prior.bias_group = static_cast<uint32_t>(groups[i]);
    if (!subproblem.scene.images.contains(prior.image))
      return absl::DataLossError("world block: a prior of an image it does not hold");
    const auto is_sigma = [](double sigma_m) { return codec::IsSigma(sigma_m); };
    ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
        codec::IsPlace(prior.position_in_world) && std::ranges::all_of(sigmas[i], is_sigma),
        "world block",
        "a prior is no position"));
    subproblem.priors.push_back(prior);
  }
  return absl::OkStatus();
}

using DirectionBytes = std::array<double, 7>;

void DirectionsToProto(const Subproblem& subproblem, v1::Subproblem* proto) {
  std::vector<ImageId> images;
  std::vector<DirectionBytes> directions;
  for (const SubproblemDirection& direction : subproblem.directions) {
    const Eigen::Vector3d& in_world = direction.direction_in_world;
    const Eigen::Vector3d& in_cam = direction.direction_in_cam;
    images.push_back(direction.image);
    directions.push_back({in_world.x(),
                          in_world.y(),
                          in_world.z(),
                          in_cam.x(),
                          in_cam.y(),
                          in_cam.z(),
                          direction.sigma_rad});
  }
  proto->set_direction_images(codec::Pack(images));
  proto->set_directions(codec::Pack(directions));
}

absl::Status DirectionsFromProto(const v1::Subproblem& proto, Subproblem& subproblem) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images,
                            codec::Unpack<ImageId>(proto.direction_images(), "directions"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto directions,
      codec::UnpackExactly<DirectionBytes>(proto.directions(), images.size(), "directions"));
  for (size_t i = 0; i < images.size(); ++i) {
    const DirectionBytes& d = directions[i];
    if (!subproblem.scene.images.contains(images[i]))
      return absl::DataLossError("world block: a direction of an image it does not hold");
    if (!codec::AreNumbers(Eigen::Map<const Eigen::Matrix<double, 6, 1>>(d.data())) ||
        !codec::IsSigma(d[6]))
      return absl::DataLossError("world block: a direction is not a number");
    subproblem.directions.push_back({.image = images[i],
                                     .direction_in_world = {d[0], d[1], d[2]},
                                     .direction_in_cam = {d[3], d[4], d[5]},
                                     .sigma_rad = d[6]});
  }
  return absl::OkStatus();
}

using DriveErrorBytes = std::array<double, 7>;

void ErrorsToProto(const Georeference& georeference, v1::Georeference* proto) {
  std::vector<std::array<uint32_t, 2>> drives;
  std::vector<DriveErrorBytes> values;
  for (const DriveErrors& errors : georeference.drive_errors) {
    drives.push_back({errors.drive, errors.has_times ? 1U : 0U});
    const Eigen::Vector3d& offset_m = errors.offset_m;
    values.push_back({errors.ahead,
                      errors.left_m,
                      errors.ahead_sigma,
                      errors.left_sigma_m,
                      offset_m.x(),
                      offset_m.y(),
                      offset_m.z()});
  }
  proto->set_drives_with_errors(codec::Pack(drives));
  proto->set_drive_errors(codec::Pack(values));
  proto->set_gnss_inflation(georeference.gnss_inflation);
  for (const CrossCheck& check : georeference.checks) codec::ToProto(check, proto->add_checks());
}

absl::Status ErrorsFromProto(const v1::Georeference& proto, Georeference& georeference) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto drives,
      (codec::Unpack<std::array<uint32_t, 2>>(proto.drives_with_errors(), "drives")));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto values,
      codec::UnpackExactly<DriveErrorBytes>(proto.drive_errors(), drives.size(), "drive errors"));
  for (size_t i = 0; i < drives.size(); ++i) {
    const DriveErrorBytes& v = values[i];
    if (!std::ranges::all_of(v, codec::IsLength) || v[2] < 0.0 || v[3] < 0.0)
      return absl::DataLossError("drive errors: not a number");
    if (drives[i][1] > 1) return absl::DataLossError("drive errors: unknown flags");
    georeference.drive_errors.push_back({.drive = drives[i][0],
                                         .has_times = drives[i][1] != 0,
                                         .ahead = v[0],
                                         .left_m = v[1],
                                         .ahead_sigma = v[2],
                                         .left_sigma_m = v[3],
                                         .offset_m = {v[4], v[5], v[6]}});
  }
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      codec::Ascends(georeference.drive_errors, &DriveErrors::drive), "drive errors", "no order"));
  if (!codec::IsNumber(proto.gnss_inflation()) || !(proto.gnss_inflation() >= 1.0))
    return absl::DataLossError("georeference: positions worth more than they are");
  georeference.gnss_inflation = proto.gnss_inflation();
  for (const v1::CrossCheck& check : proto.checks()) {
    ORBWEAVE_ASSIGN_OR_RETURN(CrossCheck decoded, codec::FromProto(check));
    georeference.checks.push_back(std::move(decoded));
  }
  return absl::OkStatus();
}

void ToProto(const Subproblem& subproblem, v1::Subproblem* proto) {
  proto->set_world(subproblem.world);
  proto->set_cluster(subproblem.cluster);
  codec::ToProto(subproblem.scene, proto->mutable_scene());
  ImagesToProto(subproblem, proto);
  SplitToProto(subproblem, proto);
  PriorsToProto(subproblem, proto);
  codec::ToProto(subproblem.biases, proto->mutable_biases());
  DirectionsToProto(subproblem, proto);
  if (subproblem.farthest) proto->set_farthest(subproblem.farthest->value);
}

/// Whether terms of the adjustment can depend on its pose.
bool IsFirm(const Subproblem& subproblem, ImageId id) {
  const auto image = subproblem.scene.images.find(id);
  return image != subproblem.scene.images.end() && !image->second.loose;
}

absl::Status CheckGauge(const Subproblem& subproblem) {
  using codec::Expect;
  const auto is_both = [](const SubproblemImage& image) {
    return image.is_held && image.is_separator;
  };
  ORBWEAVE_RETURN_IF_ERROR(Expect(std::ranges::none_of(subproblem.images, is_both),
                                  "world block",
                                  "an image is held and moves"));
  const auto held = std::ranges::find_if(subproblem.images, &SubproblemImage::is_held);
  const bool holds = held != subproblem.images.end();
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(std::ranges::count_if(subproblem.images, &SubproblemImage::is_held) <= 1 &&
                 (!holds || IsFirm(subproblem, held->id)),
             "world block",
             "it holds more than one image, or one without a place"));
  const std::optional<ImageId>& farthest = subproblem.farthest;
  return Expect(!farthest || (holds && *farthest != held->id && IsFirm(subproblem, *farthest)),
                "world block",
                "a distance that it cannot hold");
}

/// What its terms name is there.
absl::Status CheckTerms(const Subproblem& subproblem) {
  using codec::Expect;
  constexpr char kWhat[] = "world block";
  const auto is_firm = [&](ImageId id) { return IsFirm(subproblem, id); };
  const auto is_seen_firmly = [&](const Track& track) {
    return std::ranges::all_of(track.observations,
                               [&](const Observation& seen) { return is_firm(seen.ref.image); });
  };
  const auto has_bias = [&](const SubproblemPrior& prior) {
    return !prior.bias_group ||
           std::ranges::binary_search(
               subproblem.biases, *prior.bias_group, {}, &SubproblemBias::group);
  };
  const auto moves_nothing = [](const SubproblemBias& bias) {
    return bias.is_separator && bias.sigma_m == 0.0;
  };
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(std::ranges::all_of(subproblem.scene.tracks, is_seen_firmly) &&
                 std::ranges::all_of(subproblem.split, is_seen_firmly, &SplitTrack::part),
             kWhat,
             "a track is seen by an image without a place"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(std::ranges::all_of(subproblem.priors, is_firm, &SubproblemPrior::image) &&
                 std::ranges::all_of(subproblem.directions, is_firm, &SubproblemDirection::image),
             kWhat,
             "a prior of an image without a place"));
  ORBWEAVE_RETURN_IF_ERROR(Expect(std::ranges::all_of(subproblem.priors, has_bias),
                                  kWhat,
                                  "a prior of a drive whose bias it does not have"));
  return Expect(std::ranges::none_of(subproblem.biases, moves_nothing),
                kWhat,
                "a bias that cannot move and shall");
}

absl::StatusOr<Subproblem> FromProto(const v1::Subproblem& proto) {
  Subproblem subproblem{.world = proto.world(), .cluster = proto.cluster()};
  ORBWEAVE_ASSIGN_OR_RETURN(subproblem.scene, codec::FromProto(proto.scene()));
  ORBWEAVE_RETURN_IF_ERROR(ImagesFromProto(proto, subproblem));
  ORBWEAVE_RETURN_IF_ERROR(SplitFromProto(proto, subproblem));
  ORBWEAVE_RETURN_IF_ERROR(PriorsFromProto(proto, subproblem));
  ORBWEAVE_RETURN_IF_ERROR(DirectionsFromProto(proto, subproblem));
  ORBWEAVE_ASSIGN_OR_RETURN(subproblem.biases, codec::FromProto(proto.biases()));
  if (proto.has_farthest()) subproblem.farthest = ImageId(proto.farthest());
  ORBWEAVE_RETURN_IF_ERROR(CheckGauge(subproblem));
  ORBWEAVE_RETURN_IF_ERROR(CheckTerms(subproblem));
  return subproblem;
}

}  // namespace

absl::StatusOr<std::string> EncodeSubproblem(const Subproblem& subproblem) {
  v1::Subproblem proto;
  ToProto(subproblem, &proto);
  return codec::Serialize(proto, "world block");
}

absl::StatusOr<Subproblem> DecodeSubproblem(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::Subproblem proto,
                            codec::Parse<v1::Subproblem>(bytes, "world block"));
  return FromProto(proto);
}

absl::StatusOr<std::string> EncodeAssembleRecipe(const AssembleRecipe& recipe) {
  v1::AssembleRecipe proto;
  ToProto(recipe.joined.subproblem, proto.mutable_subproblem());
  for (const PlacedSubmodel& placed : recipe.joined.submodels) {
    v1::PlacedSubmodel* out = proto.add_submodels();
    out->set_submodel(placed.submodel);
    codec::ToProto(placed.world_from_submodel, out->mutable_world_from_submodel());
  }
  proto.set_cluster_result(codec::PackDigest(recipe.cluster_result));
  proto.set_shared(codec::Pack(recipe.shared));
  return codec::Serialize(proto, "assemble recipe");
}

absl::StatusOr<AssembleRecipe> DecodeAssembleRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::AssembleRecipe proto,
                            codec::Parse<v1::AssembleRecipe>(bytes, "assemble recipe"));
  AssembleRecipe recipe;
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.joined.subproblem, FromProto(proto.subproblem()));
  for (const v1::PlacedSubmodel& placed : proto.submodels()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Sim3 pose,
                              codec::PlacementFromProto(placed.world_from_submodel()));
    recipe.joined.submodels.push_back({placed.submodel(), pose});
  }
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.cluster_result, codec::UnpackDigest(proto.cluster_result()));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.shared, codec::Unpack<ImageId>(proto.shared(), "shared images"));
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::Ascends(recipe.shared) &&
                        codec::Ascends(recipe.joined.submodels, &PlacedSubmodel::submodel),
                    "assemble recipe",
                    "shared images or submodels are not in order"));
  return recipe;
}

absl::StatusOr<std::string> EncodeJoinedWorlds(const std::vector<JoinedWorld>& worlds) {
  v1::JoinedWorlds proto;
  for (const JoinedWorld& world : worlds) {
    v1::JoinedWorld* out = proto.add_worlds();
    v1::Georeference* georeference = out->mutable_georeference();
    if (world.georeference.enu_from_world)
      codec::ToProto(*world.georeference.enu_from_world, georeference->mutable_enu_from_world());
    georeference->set_reason(world.georeference.reason);
    georeference->set_horizontal_scatter_m(world.georeference.horizontal_scatter_m);
    georeference->set_vertical_scatter_m(world.georeference.vertical_scatter_m);
    georeference->set_scale_uncertainty(world.georeference.scale_uncertainty);
    georeference->set_deformation_m(world.georeference.deformation_m);
    ErrorsToProto(world.georeference, georeference);
    out->set_united_tracks(world.merge.united_tracks);
    out->set_conflicting_tracks(world.merge.conflicting_tracks);
    out->set_num_images(world.num_images);
    out->set_num_subproblems(world.num_subproblems);
  }
  return codec::Serialize(proto, "joined worlds", codec::Empty::kIsLegal);
}

namespace {

/// Of a model without extent the uncertainty of its scale is no number.
absl::Status CheckGeoreference(const Georeference& georeference) {
  return codec::Expect(
      codec::IsAmount(georeference.horizontal_scatter_m) &&
          codec::IsAmount(georeference.vertical_scatter_m) &&
          codec::IsAmount(georeference.deformation_m) &&
          (!georeference.enu_from_world || codec::IsAmount(georeference.scale_uncertainty)),
      "georeference",
      "a distance or a share is none");
}

absl::Status CheckCosts(const PointCosts& costs) {
  return codec::Expect(
      codec::IsAmount(costs.total) && std::ranges::all_of(costs.per_point, codec::IsAmount),
      "block state",
      "a cost is none");
}

}  // namespace

absl::StatusOr<std::vector<JoinedWorld>> DecodeJoinedWorlds(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::JoinedWorlds proto,
      codec::Parse<v1::JoinedWorlds>(bytes, "joined worlds", codec::Empty::kIsLegal));
  std::vector<JoinedWorld> worlds;
  for (const v1::JoinedWorld& world : proto.worlds()) {
    const v1::Georeference& georeference = world.georeference();
    JoinedWorld& out = worlds.emplace_back();
    if (georeference.has_enu_from_world()) {
      ORBWEAVE_ASSIGN_OR_RETURN(out.georeference.enu_from_world,
                                codec::PlacementFromProto(georeference.enu_from_world()));
    }
    out.georeference.reason = georeference.reason();
    out.georeference.horizontal_scatter_m = georeference.horizontal_scatter_m();
    out.georeference.vertical_scatter_m = georeference.vertical_scatter_m();
    out.georeference.scale_uncertainty = georeference.scale_uncertainty();
    out.georeference.deformation_m = georeference.deformation_m();
    ORBWEAVE_RETURN_IF_ERROR(ErrorsFromProto(georeference, out.georeference));
    ORBWEAVE_RETURN_IF_ERROR(CheckGeoreference(out.georeference));
    out.merge = {world.united_tracks(), world.conflicting_tracks()};
    out.num_images = world.num_images();
    out.num_subproblems = world.num_subproblems();
  }
  return worlds;
}

absl::StatusOr<std::string> EncodeSubproblemState(const EvaluatedState& state) {
  v1::SubproblemState proto;
  std::vector<PoseBytes> poses;
  for (const PoseState& pose : state.variables.poses) {
    const Eigen::Quaterniond& q = pose.rotation;
    const Eigen::Vector3d& c = pose.centre;
    poses.push_back({q.w(), q.x(), q.y(), q.z(), c.x(), c.y(), c.z()});
  }
  proto.set_poses(codec::Pack(poses));
  proto.set_points(codec::PackVectors(state.variables.points));
  proto.set_biases(codec::PackVectors(state.variables.biases));
  proto.set_costs(codec::Pack(state.costs.per_point));
  proto.set_total_cost(state.costs.total);
  proto.set_retained_before(codec::PackVectors(state.retained_points_before));
  return codec::Serialize(proto, "block state", codec::Empty::kIsLegal);
}

absl::StatusOr<EvaluatedState> DecodeSubproblemState(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::SubproblemState proto,
      codec::Parse<v1::SubproblemState>(bytes, "block state", codec::Empty::kIsLegal));
  EvaluatedState state;
  ORBWEAVE_ASSIGN_OR_RETURN(const auto poses, codec::Unpack<PoseBytes>(proto.poses(), "poses"));
  for (const PoseBytes& a : poses) {
    const Eigen::Quaterniond q(a[0], a[1], a[2], a[3]);
    if (!(std::abs(q.norm() - 1.0) < 1e-6) || !codec::IsLength(a[4]) || !codec::IsLength(a[5]) ||
        !codec::IsLength(a[6]))
      return absl::DataLossError("block state: a pose is not a rigid motion");
    state.variables.poses.push_back(MakePoseState(q, {a[4], a[5], a[6]}));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(state.variables.points, codec::UnpackVectors(proto.points(), "points"));
  ORBWEAVE_ASSIGN_OR_RETURN(state.variables.biases, codec::UnpackVectors(proto.biases(), "biases"));
  ORBWEAVE_ASSIGN_OR_RETURN(state.costs.per_point, codec::Unpack<double>(proto.costs(), "costs"));
  state.costs.total = proto.total_cost();
  ORBWEAVE_RETURN_IF_ERROR(CheckCosts(state.costs));
  ORBWEAVE_ASSIGN_OR_RETURN(state.retained_points_before,
                            codec::UnpackVectors(proto.retained_before(), "kept points"));
  return state;
}

}  // namespace orbweave
