// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/dense_codec.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orbweave/v1/dense.pb.h"
#include "proto/codec/pack.h"
#include "proto/codec/pack_matrices.h"
#include "proto/codec/plausible.h"

namespace orbweave {
namespace {

constexpr uint32_t kMaxWidth_px = 1 << 16;
constexpr uint32_t kWidthStep_px = 16;
constexpr double kUnitTolerance = 1e-4;  // seeds are rounded

using SeedValues = Eigen::Matrix<double, 5, 1>;

bool IsPositive(double value) { return value > 0.0 && codec::IsLength(value); }

bool IsUnit(double unit_m) {
  return unit_m > 1.0 / codec::kMostLength && unit_m < codec::kMostLength;
}

bool IsCell(const TileCell& cell) {
  return codec::IsCellNumber(cell.x) && codec::IsCellNumber(cell.y);
}

std::string PackSeeds(const std::vector<DepthSeed>& seeds) {
  std::vector<SeedValues> values;
  for (const DepthSeed& seed : seeds) {
    values.emplace_back();
    values.back() << seed.bearing, seed.range_m, seed.sigma_m;
  }
  return codec::PackMatrices(values);
}

absl::StatusOr<std::vector<DepthSeed>> UnpackSeeds(const std::string& bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto values,
      codec::UnpackMatrices<SeedValues>(bytes, bytes.size() / sizeof(SeedValues), "seeds"));
  std::vector<DepthSeed> seeds;
  for (const SeedValues& value : values) {
    seeds.push_back({value.head<3>(), value[3], value[4]});
    if (!(std::abs(seeds.back().bearing.norm() - 1.0) < kUnitTolerance) || !IsPositive(value[3]) ||
        !IsPositive(value[4])) {
      return absl::DataLossError("seeds: a bearing, range or sigma that is none");
    }
  }
  return seeds;
}

absl::Status CheckRange(double min_range, double max_range) {
  if (IsPositive(min_range) && IsPositive(max_range) && max_range > min_range)
    return absl::OkStatus();
  return absl::DataLossError("dense: a range of depths that is none");
}

void ToProto(const PanoramaFile& file, v1::PanoramaFile* proto) {
  proto->set_image(file.image.value);
  proto->set_width_px(static_cast<uint32_t>(file.camera.width_px));
  proto->set_height_px(static_cast<uint32_t>(file.camera.height_px));
  proto->set_content(codec::PackDigest(file.content));
  proto->set_mask(codec::PackDigest(file.mask));
}

absl::StatusOr<PanoramaFile> FromProto(const v1::PanoramaFile& proto) {
  if (proto.width_px() == 0 || proto.width_px() > kMaxWidth_px || proto.height_px() == 0 ||
      proto.height_px() > kMaxWidth_px) {
    return absl::DataLossError("dense: a panorama of no size");
  }
  PanoramaFile file{
      .image = ImageId(proto.image()),
      .camera = {static_cast<int>(proto.width_px()), static_cast<int>(proto.height_px())}};
  ORBWEAVE_ASSIGN_OR_RETURN(file.content, codec::UnpackDigest(proto.content()));
  ORBWEAVE_ASSIGN_OR_RETURN(file.mask, codec::UnpackDigest(proto.mask()));
  if (file.content.IsZero()) return absl::DataLossError("dense: a panorama without picture");
  return file;
}

void ToProto(const SourceChoice& choice, v1::SourceChoice* proto) {
  proto->set_image(choice.image.value);
  proto->set_sources(codec::Pack(choice.sources));
  proto->set_seeds(PackSeeds(choice.seeds));
  proto->set_min_range_m(choice.min_range_m);
  proto->set_max_range_m(choice.max_range_m);
  proto->set_problem(choice.problem);
}

absl::StatusOr<SourceChoice> FromProto(const v1::SourceChoice& proto) {
  SourceChoice choice{.image = ImageId(proto.image()),
                      .min_range_m = proto.min_range_m(),
                      .max_range_m = proto.max_range_m(),
                      .problem = proto.problem()};
  ORBWEAVE_ASSIGN_OR_RETURN(choice.sources, codec::Unpack<ImageId>(proto.sources(), "sources"));
  ORBWEAVE_ASSIGN_OR_RETURN(choice.seeds, UnpackSeeds(proto.seeds()));
  if (!choice.sources.empty())
    ORBWEAVE_RETURN_IF_ERROR(CheckRange(choice.min_range_m, choice.max_range_m));
  if (!codec::IsNumber(choice.min_range_m) || !codec::IsNumber(choice.max_range_m))
    return absl::DataLossError("dense: a range of depths that is none");
  return choice;
}

void ToProto(const PlacedMap& map, v1::PlacedMap* proto) {
  proto->set_image(map.image.value);
  proto->set_map(codec::PackDigest(map.map));
  proto->set_unit_m(map.unit_m);
  codec::ToProto(map.cam_from_model, proto->mutable_cam_from_model());
  proto->set_reach_m(map.reach_m);
}

absl::StatusOr<PlacedMap> FromProto(const v1::PlacedMap& proto) {
  PlacedMap map{
      .image = ImageId(proto.image()), .unit_m = proto.unit_m(), .reach_m = proto.reach_m()};
  ORBWEAVE_ASSIGN_OR_RETURN(map.map, codec::UnpackDigest(proto.map()));
  ORBWEAVE_ASSIGN_OR_RETURN(map.cam_from_model, codec::FromProto(proto.cam_from_model()));
  if (map.map.IsZero() || !IsUnit(map.unit_m) || !codec::IsAmount(map.reach_m))
    return absl::DataLossError("dense: a depth map that is none");
  return map;
}

template <typename Repeated>
absl::StatusOr<std::vector<PlacedMap>> MapsFromProto(const Repeated& proto) {
  std::vector<PlacedMap> maps;
  for (const v1::PlacedMap& map : proto) {
    ORBWEAVE_ASSIGN_OR_RETURN(maps.emplace_back(), FromProto(map));
  }
  return maps;
}

template <typename Repeated>
absl::StatusOr<std::vector<Digest>> DigestsFromProto(const Repeated& proto) {
  std::vector<Digest> digests;
  for (const std::string& bytes : proto) {
    ORBWEAVE_ASSIGN_OR_RETURN(digests.emplace_back(), codec::UnpackDigest(bytes));
    if (digests.back().IsZero()) return absl::DataLossError("dense: points without a name");
  }
  return digests;
}

}  // namespace

absl::StatusOr<std::string> EncodeViewRecipe(const ViewRecipe& recipe) {
  v1::ViewRecipe proto;
  proto.set_world(recipe.world);
  codec::ToProto(recipe.model_from_world, proto.mutable_model_from_world());
  proto.set_subproblem(codec::PackDigest(recipe.subproblem));
  return codec::Serialize(proto, "view recipe");
}

absl::StatusOr<ViewRecipe> DecodeViewRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::ViewRecipe proto,
                            codec::Parse<v1::ViewRecipe>(bytes, "view recipe"));
  ViewRecipe recipe{.world = proto.world()};
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.model_from_world,
                            codec::PlacementFromProto(proto.model_from_world()));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.subproblem, codec::UnpackDigest(proto.subproblem()));
  if (recipe.subproblem.IsZero()) return absl::DataLossError("view recipe: no subproblem");
  return recipe;
}

absl::StatusOr<std::string> EncodeChosenSources(const ChosenSources& chosen) {
  v1::ChosenSources proto;
  proto.set_world(chosen.world);
  for (const SourceChoice& choice : chosen.choices) ToProto(choice, proto.add_choices());
  return codec::Serialize(proto, "chosen sources", codec::Empty::kIsLegal);
}

absl::StatusOr<ChosenSources> DecodeChosenSources(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::ChosenSources proto,
      codec::Parse<v1::ChosenSources>(bytes, "chosen sources", codec::Empty::kIsLegal));
  ChosenSources chosen{.world = proto.world()};
  for (const v1::SourceChoice& choice : proto.choices()) {
    ORBWEAVE_ASSIGN_OR_RETURN(chosen.choices.emplace_back(), FromProto(choice));
  }
  return chosen;
}

absl::StatusOr<std::string> EncodeDepthRecipe(const DepthRecipe& recipe) {
  v1::DepthRecipe proto;
  ToProto(recipe.reference, proto.mutable_reference());
  for (const DepthSourceFile& source : recipe.sources) {
    ToProto(source.panorama, proto.add_sources());
    codec::ToProto(source.source_from_reference, proto.add_sources_from_reference());
  }
  proto.set_seeds(PackSeeds(recipe.seeds));
  proto.set_min_range(recipe.min_range);
  proto.set_max_range(recipe.max_range);
  proto.set_mask_ignores_white(recipe.mask_ignores_white);
  proto.set_width_px(static_cast<uint32_t>(recipe.width_px));
  return codec::Serialize(proto, "depth recipe");
}

absl::StatusOr<DepthRecipe> DecodeDepthRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::DepthRecipe proto,
                            codec::Parse<v1::DepthRecipe>(bytes, "depth recipe"));
  DepthRecipe recipe{.min_range = proto.min_range(),
                     .max_range = proto.max_range(),
                     .mask_ignores_white = proto.mask_ignores_white(),
                     .width_px = static_cast<int>(proto.width_px())};
  if (proto.width_px() > kMaxWidth_px || proto.width_px() % kWidthStep_px != 0)
    return absl::DataLossError("depth recipe: a width that does not halve evenly");
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.reference, FromProto(proto.reference()));
  if (proto.sources_size() != proto.sources_from_reference_size())
    return absl::DataLossError("depth recipe: not one pose for each source");
  for (int i = 0; i < proto.sources_size(); ++i) {
    DepthSourceFile& source = recipe.sources.emplace_back();
    ORBWEAVE_ASSIGN_OR_RETURN(source.panorama, FromProto(proto.sources(i)));
    ORBWEAVE_ASSIGN_OR_RETURN(source.source_from_reference,
                              codec::FromProto(proto.sources_from_reference(i)));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.seeds, UnpackSeeds(proto.seeds()));
  ORBWEAVE_RETURN_IF_ERROR(CheckRange(recipe.min_range, recipe.max_range));
  return recipe;
}

absl::StatusOr<std::string> EncodeDensePlan(const DensePlan& plan) {
  v1::DensePlan proto;
  proto.set_mask_ignores_white(plan.mask_ignores_white);
  for (const DensePanorama& panorama : plan.panoramas) {
    v1::DensePanorama* out = proto.add_panoramas();
    ToProto(panorama.file, out->mutable_file());
    codec::ToProto(panorama.cam_from_model, out->mutable_cam_from_model());
    out->set_unit_m(panorama.unit_m);
    out->set_sources(codec::Pack(panorama.sources));
  }
  for (const DenseOmission& omission : plan.omitted) {
    v1::DenseOmission* out = proto.add_omitted();
    out->set_image(omission.image.value);
    out->set_reason(omission.reason);
  }
  return codec::Serialize(proto, "dense plan", codec::Empty::kIsLegal);
}

absl::StatusOr<DensePlan> DecodeDensePlan(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::DensePlan proto,
      codec::Parse<v1::DensePlan>(bytes, "dense plan", codec::Empty::kIsLegal));
  DensePlan plan{.mask_ignores_white = proto.mask_ignores_white()};
  for (const v1::DensePanorama& in : proto.panoramas()) {
    DensePanorama& panorama = plan.panoramas.emplace_back();
    panorama.unit_m = in.unit_m();
    ORBWEAVE_ASSIGN_OR_RETURN(panorama.file, FromProto(in.file()));
    ORBWEAVE_ASSIGN_OR_RETURN(panorama.cam_from_model, codec::FromProto(in.cam_from_model()));
    ORBWEAVE_ASSIGN_OR_RETURN(panorama.sources, codec::Unpack<ImageId>(in.sources(), "sources"));
    if (!IsUnit(panorama.unit_m)) return absl::DataLossError("dense plan: a unit that is none");
  }
  for (const v1::DenseOmission& omission : proto.omitted())
    plan.omitted.push_back({ImageId(omission.image()), omission.reason()});
  return plan;
}

absl::StatusOr<std::string> EncodeCheckRecipe(const CheckRecipe& recipe) {
  v1::CheckRecipe proto;
  ToProto(recipe.own, proto.mutable_own());
  for (const PlacedMap& source : recipe.sources) ToProto(source, proto.add_sources());
  return codec::Serialize(proto, "check recipe");
}

absl::StatusOr<CheckRecipe> DecodeCheckRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::CheckRecipe proto,
                            codec::Parse<v1::CheckRecipe>(bytes, "check recipe"));
  CheckRecipe recipe;
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.own, FromProto(proto.own()));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.sources, MapsFromProto(proto.sources()));
  return recipe;
}

absl::StatusOr<std::string> EncodeFuseRecipe(const FuseRecipe& recipe) {
  v1::FuseRecipe proto;
  ToProto(recipe.own, proto.mutable_own());
  ToProto(recipe.file, proto.mutable_file());
  proto.set_mask_ignores_white(recipe.mask_ignores_white);
  for (const PlacedMap& neighbour : recipe.neighbours) ToProto(neighbour, proto.add_neighbours());
  return codec::Serialize(proto, "fuse recipe");
}

absl::StatusOr<FuseRecipe> DecodeFuseRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::FuseRecipe proto,
                            codec::Parse<v1::FuseRecipe>(bytes, "fuse recipe"));
  FuseRecipe recipe{.mask_ignores_white = proto.mask_ignores_white()};
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.own, FromProto(proto.own()));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.file, FromProto(proto.file()));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.neighbours, MapsFromProto(proto.neighbours()));
  return recipe;
}

absl::StatusOr<std::string> EncodeTileRuns(const TileRuns& runs) {
  v1::TileRuns proto;
  std::vector<TileCell> cells;
  std::vector<uint64_t> counts;
  for (const PointsOfCell& run : runs.runs) {
    cells.push_back(run.cell);
    counts.push_back(run.count);
    proto.add_points(codec::PackDigest(run.points));
  }
  proto.set_cells(codec::Pack(cells));
  proto.set_counts(codec::Pack(counts));
  return codec::Serialize(proto, "tile runs", codec::Empty::kIsLegal);
}

absl::StatusOr<TileRuns> DecodeTileRuns(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::TileRuns proto,
                            codec::Parse<v1::TileRuns>(bytes, "tile runs", codec::Empty::kIsLegal));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> points, DigestsFromProto(proto.points()));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto cells,
                            codec::UnpackExactly<TileCell>(proto.cells(), points.size(), "cells"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto counts, codec::UnpackExactly<uint64_t>(proto.counts(), points.size(), "counts"));
  TileRuns runs;
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      codec::Ascends(cells) && std::ranges::all_of(cells, IsCell), "tile runs", "not in order"));
  for (size_t i = 0; i < points.size(); ++i)
    runs.runs.push_back({.cell = cells[i], .count = counts[i], .points = points[i]});
  return runs;
}

absl::StatusOr<std::string> EncodeTileRecipe(const TileRecipe& recipe) {
  v1::TileRecipe proto;
  proto.set_x(recipe.cell.x);
  proto.set_y(recipe.cell.y);
  proto.set_piece(recipe.piece);
  for (const Digest& points : recipe.points) proto.add_points(codec::PackDigest(points));
  return codec::Serialize(proto, "tile recipe");
}

absl::StatusOr<TileRecipe> DecodeTileRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::TileRecipe proto,
                            codec::Parse<v1::TileRecipe>(bytes, "tile recipe"));
  TileRecipe recipe{.cell = {proto.x(), proto.y()}, .piece = proto.piece()};
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.points, DigestsFromProto(proto.points()));
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(IsCell(recipe.cell), "tile recipe", "its cell is nowhere"));
  return recipe;
}

}  // namespace orbweave
