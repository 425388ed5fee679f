// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/inspection_codec.h"

#include <algorithm>
#include <array>
#include <vector>

#include "orbweave/v1/adjustment.pb.h"
#include "proto/codec/adjustment_messages.h"
#include "proto/codec/pack.h"
#include "proto/codec/pack_matrices.h"
#include "proto/codec/plausible.h"
#include "proto/codec/reconstruction_messages.h"

namespace orbweave {
namespace {

using SeenBetweenBytes = std::array<uint32_t, 3>;
using CorrelationBytes = std::array<double, TrackCorrelation::kLengths>;

void ToProto(const std::vector<SidePlacement>& placements, v1::SubproblemInspection* proto) {
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

absl::StatusOr<std::vector<SidePlacement>> PlacementsOf(const v1::SubproblemInspection& proto) {
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
  for (size_t i = 0; i < count; ++i) {
    if (!codec::AreNumbers(hessians[i]) || !codec::AreNumbers(gradients[i]))
      return absl::DataLossError("block inspection: a placement that is not a number");
    placements.push_back({images[i], clusters[i], hessians[i], gradients[i], points[i]});
  }
  return placements;
}

void ToProto(const std::vector<PatchSupport>& supports, v1::SubproblemInspection* proto) {
  std::vector<ImageId> images;
  std::vector<uint32_t> patches;
  std::vector<std::array<uint32_t, 2>> counts;
  std::vector<Block6> hessians;
  std::vector<Vector6> gradients;
  std::vector<std::array<double, 2>> squares;
  for (const PatchSupport& support : supports) {
    images.push_back(support.image);
    patches.push_back(support.patch);
    counts.push_back({support.observations, support.equations});
    hessians.push_back(support.hessian);
    gradients.push_back(support.gradient);
    squares.push_back({support.sum_of_squares, support.redundancy});
  }
  proto->set_support_images(codec::Pack(images));
  proto->set_support_patches(codec::Pack(patches));
  proto->set_support_counts(codec::Pack(counts));
  proto->set_support_hessians(codec::PackMatrices(hessians));
  proto->set_support_gradients(codec::PackMatrices(gradients));
  proto->set_support_squares(codec::Pack(squares));
}

absl::StatusOr<std::vector<PatchSupport>> SupportsOf(const v1::SubproblemInspection& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images,
                            codec::Unpack<ImageId>(proto.support_images(), "supported images"));
  const size_t count = images.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto patches,
      codec::UnpackExactly<uint32_t>(proto.support_patches(), count, "patches"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto counts,
      (codec::UnpackExactly<std::array<uint32_t, 2>>(proto.support_counts(), count, "support")));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto hessians,
      codec::UnpackMatrices<Block6>(proto.support_hessians(), count, "support"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto gradients,
      codec::UnpackMatrices<Vector6>(proto.support_gradients(), count, "support"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto squares,
      (codec::UnpackExactly<std::array<double, 2>>(proto.support_squares(), count, "support")));
  std::vector<PatchSupport> supports;
  for (size_t i = 0; i < count; ++i) {
    if (!codec::AreNumbers(hessians[i]) || !codec::AreNumbers(gradients[i]) ||
        !codec::IsAmount(squares[i][0]) || !codec::IsNumber(squares[i][1]))
      return absl::DataLossError("block inspection: support that is not a number");
    supports.push_back({images[i],
                        patches[i],
                        counts[i][0],
                        counts[i][1],
                        hessians[i],
                        gradients[i],
                        squares[i][0],
                        squares[i][1]});
  }
  return supports;
}

absl::Status CheckSums(const SubproblemInspection& inspection) {
  using codec::Expect;
  constexpr char kWhat[] = "block inspection";
  const auto is_bias = [](const SeparatorId& id) { return id.kind == SeparatorId::Kind::kBias; };
  const TrackCorrelation& correlation = inspection.correlation;
  ORBWEAVE_RETURN_IF_ERROR(Expect(std::ranges::none_of(inspection.bearings.variables, is_bias),
                                  kWhat,
                                  "bearings that depend on a bias"));
  ORBWEAVE_RETURN_IF_ERROR(Expect(codec::IsAmount(inspection.sum_of_squares) &&
                                      codec::IsAmount(inspection.weighted_sum_of_squares) &&
                                      codec::IsNumber(inspection.redundancy),
                                  kWhat,
                                  "a sum is none"));
  return Expect(std::ranges::all_of(correlation.products, codec::IsNumber) &&
                    std::ranges::all_of(correlation.squares, codec::IsAmount) &&
                    std::ranges::all_of(correlation.tracks, codec::IsAmount),
                kWhat,
                "a correlation is none");
}

}  // namespace

absl::StatusOr<std::string> EncodeSubproblemInspection(const SubproblemInspection& inspection) {
  v1::SubproblemInspection proto;
  codec::ToProto(inspection.bearings, proto.mutable_bearings());
  proto.set_sum_of_squares(inspection.sum_of_squares);
  proto.set_redundancy(inspection.redundancy);
  if (inspection.held) proto.set_held(inspection.held->value);
  if (inspection.farthest) proto.set_farthest(inspection.farthest->value);
  ToProto(inspection.placements, &proto);
  proto.set_weighted_sum_of_squares(inspection.weighted_sum_of_squares);
  ToProto(inspection.supports, &proto);
  const TrackCorrelation& correlation = inspection.correlation;
  proto.set_correlation(codec::Pack(std::vector<CorrelationBytes>{
      correlation.products, correlation.squares, correlation.tracks}));
  std::vector<codec::Vector3Bytes> points_about;
  for (const Eigen::Vector3d& point : inspection.points_about)
    points_about.push_back(codec::ToArray(point));
  proto.set_points_about(codec::Pack(points_about));
  std::vector<SeenBetweenBytes> seen_between;
  for (const SeenBetween& count : inspection.seen_between)
    seen_between.push_back({count.image.value, count.asked, count.seen});
  proto.set_seen_between(codec::Pack(seen_between));
  return codec::Serialize(proto, "block inspection");
}

absl::StatusOr<SubproblemInspection> DecodeSubproblemInspection(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::SubproblemInspection proto,
                            codec::Parse<v1::SubproblemInspection>(bytes, "block inspection"));
  SubproblemInspection inspection{.sum_of_squares = proto.sum_of_squares(),
                                  .weighted_sum_of_squares = proto.weighted_sum_of_squares(),
                                  .redundancy = proto.redundancy()};
  ORBWEAVE_ASSIGN_OR_RETURN(inspection.bearings, codec::FromProto(proto.bearings()));
  if (proto.has_held()) inspection.held = ImageId(proto.held());
  if (proto.has_farthest()) inspection.farthest = ImageId(proto.farthest());
  ORBWEAVE_ASSIGN_OR_RETURN(inspection.placements, PlacementsOf(proto));
  ORBWEAVE_ASSIGN_OR_RETURN(inspection.supports, SupportsOf(proto));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto correlation,
      codec::UnpackExactly<CorrelationBytes>(proto.correlation(), 3, "track correlation"));
  inspection.correlation = {correlation[0], correlation[1], correlation[2]};
  ORBWEAVE_RETURN_IF_ERROR(CheckSums(inspection));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto points_about,
                            codec::Unpack<codec::Vector3Bytes>(proto.points_about(), "points"));
  for (const codec::Vector3Bytes& coordinates : points_about) {
    const Eigen::Vector3d point = codec::ToVector(coordinates);
    if (!codec::IsPoint(point))
      return absl::DataLossError("block inspection: a point is not a number");
    inspection.points_about.push_back(point);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const auto seen_between,
                            codec::Unpack<SeenBetweenBytes>(proto.seen_between(), "seen between"));
  for (const auto& [image, asked, seen] : seen_between) {
    if (asked == 0 || seen > asked)
      return absl::DataLossError("block inspection: more seen than asked for");
    inspection.seen_between.push_back({ImageId(image), asked, seen});
  }
  return inspection;
}

}  // namespace orbweave
