// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/inspection_codec.h"

#include <vector>

#include "orbweave/v1/adjustment.pb.h"
#include "proto/codec/adjustment_messages.h"
#include "proto/codec/pack.h"
#include "proto/codec/pack_matrices.h"

namespace orbweave {
namespace {

void ToProto(const std::vector<SidePlacement>& placements, v1::BlockInspection* proto) {
  std::vector<ImageId> images;
  std::vector<uint32_t> clusters;
  std::vector<Block6> hessians;
  std::vector<Vector6> gradients;
  std::vector<uint32_t> points;
  for (const SidePlacement& placement : placements) {
    images.push_back(placement.image);
    clusters.push_back(placement.cluster);
    hessians.push_back(placement.hessian);
    gradients.push_back(placement.gradient);
    points.push_back(placement.num_points);
  }
  proto->set_placed_images(codec::Pack(images));
  proto->set_placing_clusters(codec::Pack(clusters));
  proto->set_placement_hessians(codec::PackMatrices(hessians));
  proto->set_placement_gradients(codec::PackMatrices(gradients));
  proto->set_placement_points(codec::Pack(points));
}

absl::StatusOr<std::vector<SidePlacement>> PlacementsOf(const v1::BlockInspection& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images,
                            codec::Unpack<ImageId>(proto.placed_images(), "placed images"));
  const size_t count = images.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto clusters,
      codec::UnpackExactly<uint32_t>(proto.placing_clusters(), count, "placing clusters"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto hessians,
      codec::UnpackMatrices<Block6>(proto.placement_hessians(), count, "placements"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto gradients,
      codec::UnpackMatrices<Vector6>(proto.placement_gradients(), count, "placements"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto points,
      codec::UnpackExactly<uint32_t>(proto.placement_points(), count, "placements"));
  std::vector<SidePlacement> placements;
  for (size_t i = 0; i < count; ++i)
    placements.push_back({images[i], clusters[i], hessians[i], gradients[i], points[i]});
  return placements;
}

}  // namespace

std::string EncodeBlockInspection(const BlockInspection& inspection) {
  v1::BlockInspection proto;
  codec::ToProto(inspection.bearings, proto.mutable_bearings());
  proto.set_sum_of_squares(inspection.sum_of_squares);
  proto.set_redundancy(inspection.redundancy);
  if (inspection.held) proto.set_held(inspection.held->value);
  if (inspection.farthest) proto.set_farthest(inspection.farthest->value);
  ToProto(inspection.placements, &proto);
  return proto.SerializeAsString();
}

absl::StatusOr<BlockInspection> DecodeBlockInspection(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::BlockInspection proto,
                            codec::Parse<v1::BlockInspection>(bytes, "block inspection"));
  BlockInspection inspection{.sum_of_squares = proto.sum_of_squares(),
                             .redundancy = proto.redundancy()};
  ORBWEAVE_ASSIGN_OR_RETURN(inspection.bearings, codec::FromProto(proto.bearings()));
  if (proto.has_held()) inspection.held = ImageId(proto.held());
  if (proto.has_farthest()) inspection.farthest = ImageId(proto.farthest());
  ORBWEAVE_ASSIGN_OR_RETURN(inspection.placements, PlacementsOf(proto));
  return inspection;
}

}  // namespace orbweave
