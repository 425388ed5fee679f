// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/two_view_codec.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "proto/codec/crossing_pair_message.h"
#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"

namespace orbweave {

static_assert(sizeof(FeatureMatch) == 8 && sizeof(ImagePair) == 8 && sizeof(ImageId) == 4,
              "packed as written");

namespace {

constexpr double kLongestDirection = 1.0 + 1e-6;  // zero where there is none
constexpr double kLargestAngle_rad = std::numbers::pi + 1e-6;

bool IsOrdered(const ImagePair& pair) { return pair.a < pair.b; }

absl::Status CheckGeometry(const TwoViewGeometry& geometry) {
  using codec::Expect;
  constexpr char kWhat[] = "two-view geometry";
  ORBWEAVE_RETURN_IF_ERROR(Expect(geometry.b_from_a.translation.norm() <= kLongestDirection,
                                  kWhat,
                                  "its translation is no direction"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(std::ranges::is_sorted(geometry.inliers), kWhat, "matches are not in order"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(geometry.median_angle_rad >= 0.0 && geometry.median_angle_rad <= kLargestAngle_rad,
             kWhat,
             "its angle is none"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(codec::IsShare(geometry.spread), kWhat, "its spread is no share"));
  return Expect(codec::IsNumber(geometry.log10_false_alarms), kWhat, "its evidence is no number");
}

absl::StatusOr<TwoViewGeometry> FromProto(const v1::TwoViewGeometry& proto) {
  TwoViewGeometry geometry;
  geometry.pair = {ImageId(proto.a()), ImageId(proto.b())};
  if (!(geometry.pair.a < geometry.pair.b))
    return absl::DataLossError("two-view geometry: pair out of order");
  if (proto.kind() > static_cast<uint32_t>(TwoViewKind::kPlanar)) {
    return absl::DataLossError("two-view geometry: unknown kind");
  }
  geometry.kind = static_cast<TwoViewKind>(proto.kind());
  ORBWEAVE_ASSIGN_OR_RETURN(geometry.b_from_a, codec::FromProto(proto.b_from_a()));
  ORBWEAVE_ASSIGN_OR_RETURN(geometry.inliers,
                            codec::Unpack<FeatureMatch>(proto.inliers(), "matches"));
  geometry.num_putative = proto.num_putative();
  geometry.median_angle_rad = proto.median_angle_rad();
  geometry.spread = proto.spread();
  geometry.log10_false_alarms = proto.log10_false_alarms();
  if (proto.rung() >= kNumMatchRungs) return absl::DataLossError("two-view geometry: unknown rung");
  geometry.rung = static_cast<MatchRung>(proto.rung());
  ORBWEAVE_RETURN_IF_ERROR(CheckGeometry(geometry));
  return geometry;
}

absl::Status CheckCluster(const Cluster& cluster) {
  using codec::Ascends;
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(Ascends(cluster.images) && Ascends(cluster.interior),
                                         "partition",
                                         "images of a cluster are not in order"));
  return codec::Expect(std::ranges::includes(cluster.images, cluster.interior),
                       "partition",
                       "a cluster lacks an image of its interior");
}

absl::Status CheckSeam(const Seam& seam, const std::vector<Cluster>& clusters) {
  using codec::Expect;
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(seam.cluster_a < seam.cluster_b && seam.cluster_b < clusters.size(),
             "partition",
             "a seam is not between two clusters"));
  return Expect(codec::Ascends(seam.shared) &&
                    std::ranges::includes(clusters[seam.cluster_a].images, seam.shared) &&
                    std::ranges::includes(clusters[seam.cluster_b].images, seam.shared),
                "partition",
                "a seam shares an image that its clusters do not");
}

absl::Status CheckEdges(const DividedViewGraph& divided) {
  using codec::Expect;
  const auto is_dropped_pair = [](const DroppedEdge& edge) { return IsOrdered(edge.pair); };
  ORBWEAVE_RETURN_IF_ERROR(Expect(std::ranges::all_of(divided.edges, IsOrdered) &&
                                      codec::Ascends(divided.edges) &&
                                      std::ranges::all_of(divided.dropped, is_dropped_pair),
                                  "partition",
                                  "edges are not in order"));
  const auto is_edge = [&](const CrossingPair& pair) {
    return std::ranges::binary_search(divided.edges, pair.pair);
  };
  ORBWEAVE_RETURN_IF_ERROR(Expect(
      std::ranges::all_of(divided.crossing, is_edge), "partition", "a crossing pair is no edge"));
  const auto most_kind = static_cast<uint8_t>(TwoViewKind::kPlanar);
  return Expect(
      std::ranges::all_of(divided.edge_kinds, [=](uint8_t kind) { return kind <= most_kind; }) &&
          std::ranges::all_of(divided.edge_rungs,
                              [](uint8_t rung) { return rung < kNumMatchRungs; }),
      "partition",
      "unknown kind or rung of an edge");
}

}  // namespace

absl::StatusOr<std::string> EncodeTwoViewGeometries(const std::vector<TwoViewGeometry>& pairs) {
  v1::TwoViewGeometries proto;
  for (const TwoViewGeometry& geometry : pairs) {
    v1::TwoViewGeometry* pair = proto.add_pairs();
    pair->set_a(geometry.pair.a.value);
    pair->set_b(geometry.pair.b.value);
    pair->set_kind(static_cast<uint32_t>(geometry.kind));
    codec::ToProto(geometry.b_from_a, pair->mutable_b_from_a());
    pair->set_inliers(codec::Pack(geometry.inliers));
    pair->set_num_putative(geometry.num_putative);
    pair->set_median_angle_rad(geometry.median_angle_rad);
    pair->set_spread(geometry.spread);
    pair->set_log10_false_alarms(geometry.log10_false_alarms);
    pair->set_rung(static_cast<uint32_t>(geometry.rung));
  }
  return codec::Serialize(proto, "two-view geometries", codec::Empty::kIsLegal);
}

absl::StatusOr<std::vector<TwoViewGeometry>> DecodeTwoViewGeometries(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::TwoViewGeometries proto,
      codec::Parse<v1::TwoViewGeometries>(bytes, "two-view geometries", codec::Empty::kIsLegal));
  std::vector<TwoViewGeometry> pairs;
  pairs.reserve(static_cast<size_t>(proto.pairs_size()));
  for (const v1::TwoViewGeometry& pair : proto.pairs()) {
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry, FromProto(pair));
    pairs.push_back(std::move(geometry));
  }
  return pairs;
}

absl::StatusOr<std::string> EncodeDividedViewGraph(const DividedViewGraph& divided) {
  v1::Partition proto;
  for (const Cluster& cluster : divided.partition.clusters) {
    v1::Cluster* out = proto.add_clusters();
    out->set_images(codec::Pack(cluster.images));
    out->set_interior(codec::Pack(cluster.interior));
  }
  for (const Seam& seam : divided.partition.seams) {
    v1::Seam* out = proto.add_seams();
    out->set_cluster_a(seam.cluster_a);
    out->set_cluster_b(seam.cluster_b);
    out->set_shared(codec::Pack(seam.shared));
    out->set_weakness(seam.weakness);
  }
  for (const DroppedEdge& edge : divided.dropped) {
    v1::DroppedEdge* out = proto.add_dropped();
    out->set_a(edge.pair.a.value);
    out->set_b(edge.pair.b.value);
    out->set_reason(edge.reason);
    out->set_cause(static_cast<uint32_t>(edge.cause));
  }
  codec::ToProto(divided.crossing, proto.mutable_crossing());
  proto.set_edges(codec::Pack(divided.edges));
  proto.set_edge_kinds(codec::Pack(divided.edge_kinds));
  proto.set_edge_rungs(codec::Pack(divided.edge_rungs));
  return codec::Serialize(proto, "partition", codec::Empty::kIsLegal);
}

absl::StatusOr<DividedViewGraph> DecodeDividedViewGraph(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::Partition proto,
      codec::Parse<v1::Partition>(bytes, "partition", codec::Empty::kIsLegal));
  DividedViewGraph divided;
  for (const v1::Cluster& in : proto.clusters()) {
    Cluster cluster;
    ORBWEAVE_ASSIGN_OR_RETURN(cluster.images, codec::Unpack<ImageId>(in.images(), "cluster"));
    ORBWEAVE_ASSIGN_OR_RETURN(cluster.interior, codec::Unpack<ImageId>(in.interior(), "cluster"));
    ORBWEAVE_RETURN_IF_ERROR(CheckCluster(cluster));
    divided.partition.clusters.push_back(std::move(cluster));
  }
  for (const v1::Seam& in : proto.seams()) {
    Seam seam{.cluster_a = in.cluster_a(), .cluster_b = in.cluster_b()};
    ORBWEAVE_ASSIGN_OR_RETURN(seam.shared, codec::Unpack<ImageId>(in.shared(), "seam"));
    seam.weakness = in.weakness();
    ORBWEAVE_RETURN_IF_ERROR(CheckSeam(seam, divided.partition.clusters));
    divided.partition.seams.push_back(std::move(seam));
  }
  for (const v1::DroppedEdge& in : proto.dropped()) {
    if (in.cause() > static_cast<uint32_t>(DropCause::kSequence))
      return absl::DataLossError("partition: an edge dropped for an unknown cause");
    divided.dropped.push_back(
        {{ImageId(in.a()), ImageId(in.b())}, in.reason(), static_cast<DropCause>(in.cause())});
  }
  ORBWEAVE_ASSIGN_OR_RETURN(divided.edges, codec::Unpack<ImagePair>(proto.edges(), "edges"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      divided.edge_kinds,
      codec::UnpackExactly<uint8_t>(proto.edge_kinds(), divided.edges.size(), "kinds of edges"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      divided.edge_rungs,
      codec::UnpackExactly<uint8_t>(proto.edge_rungs(), divided.edges.size(), "rungs of edges"));
  ORBWEAVE_ASSIGN_OR_RETURN(divided.crossing, codec::FromProto(proto.crossing()));
  ORBWEAVE_RETURN_IF_ERROR(CheckEdges(divided));
  return divided;
}

}  // namespace orbweave
