// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/dense_bulk_codec.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "orbweave/v1/dense.pb.h"
#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"

namespace orbweave {
namespace {

constexpr uint32_t kMaxFace_px = 1 << 14;

static_assert(sizeof(OctahedralNormal) == 4 && sizeof(Rgb) == 3, "packed as written");

size_t NumPixels(uint32_t face_px) { return size_t{6} * face_px * face_px; }

constexpr float kNormalTolerance = 1e-2F;  // of a unit vector in single precision

bool IsPositive(float value) { return value > 0.0F && codec::IsDistance(value); }
bool IsSigma(float value) { return codec::IsDistance(value); }
bool IsNormal(const Eigen::Vector3f& normal) {
  return std::abs(normal.norm() - 1.0F) < kNormalTolerance;
}

/// Those of `values` whose pixel has a range.
template <typename T>
std::string PackKnown(const DepthMap& map, const std::vector<T>& values) {
  std::vector<T> known;
  for (size_t i = 0; i < map.size(); ++i) {
    if (map.range_m[i] > 0.0F) known.push_back(values[i]);
  }
  return codec::Pack(known);
}

std::string PackMask(const DepthMap& map) {
  std::string bits((map.size() + 7) / 8, '\0');
  for (size_t i = 0; i < map.size(); ++i) {
    if (map.range_m[i] > 0.0F) bits[i / 8] = static_cast<char>(bits[i / 8] | (1 << (i % 8)));
  }
  return bits;
}

/// Indices of pixels that have a range.
absl::StatusOr<std::vector<uint32_t>> UnpackMask(const std::string& bits, size_t num_pixels) {
  if (bits.size() != (num_pixels + 7) / 8)
    return absl::DataLossError("depth map: its mask is of another size");
  std::vector<uint32_t> known;
  for (size_t i = 0; i < 8 * bits.size(); ++i) {
    if (((static_cast<uint8_t>(bits[i / 8]) >> (i % 8)) & 1) == 0) continue;
    if (i >= num_pixels) return absl::DataLossError("depth map: a pixel beyond the last");
    known.push_back(static_cast<uint32_t>(i));
  }
  return known;
}

template <typename T>
absl::Status UnpackKnown(const std::string& bytes,
                         const std::vector<uint32_t>& known,
                         const char* what,
                         std::vector<T>& values) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<T> packed,
                            codec::UnpackExactly<T>(bytes, known.size(), what));
  for (size_t i = 0; i < known.size(); ++i) values[known[i]] = packed[i];
  return absl::OkStatus();
}

using Vector3Bytes = std::array<double, 3>;
using NormalBytes = std::array<float, 3>;

void ToProto(const SurfacePoints& points, v1::SurfacePoints* proto) {
  std::vector<Vector3Bytes> positions;
  std::vector<NormalBytes> normals;
  std::vector<Rgb> colors;
  std::vector<float> sigmas;
  std::vector<uint8_t> views;
  for (const SurfacePoint& point : points) {
    const Eigen::Vector3d& X = point.position_in_world;
    const Eigen::Vector3f& n = point.normal_in_world;
    positions.push_back({X.x(), X.y(), X.z()});
    normals.push_back({n.x(), n.y(), n.z()});
    colors.push_back(point.color);
    sigmas.push_back(point.sigma_m);
    views.push_back(point.views);
  }
  proto->set_positions(codec::Pack(positions));
  proto->set_normals(codec::Pack(normals));
  proto->set_colors(codec::Pack(colors));
  proto->set_sigmas(codec::Pack(sigmas));
  proto->set_views(codec::Pack(views));
}

absl::StatusOr<SurfacePoints> FromProto(const v1::SurfacePoints& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto positions,
                            codec::Unpack<Vector3Bytes>(proto.positions(), "positions"));
  const size_t n = positions.size();
  ORBWEAVE_ASSIGN_OR_RETURN(const auto normals,
                            codec::UnpackExactly<NormalBytes>(proto.normals(), n, "normals"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto colors,
                            codec::UnpackExactly<Rgb>(proto.colors(), n, "colors"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto sigmas,
                            codec::UnpackExactly<float>(proto.sigmas(), n, "sigmas"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto views,
                            codec::UnpackExactly<uint8_t>(proto.views(), n, "views"));
  SurfacePoints points(n);
  for (size_t i = 0; i < n; ++i) {
    points[i] = {.position_in_world = Eigen::Vector3d(positions[i].data()),
                 .normal_in_world = Eigen::Vector3f(normals[i].data()),
                 .color = colors[i],
                 .sigma_m = sigmas[i],
                 .views = views[i]};
    if (!codec::IsPlace(points[i].position_in_world) || !IsNormal(points[i].normal_in_world) ||
        !IsSigma(sigmas[i])) {
      return absl::DataLossError("surface points: a number that is none");
    }
  }
  return points;
}

}  // namespace

absl::StatusOr<std::string> EncodeDepthMap(const DepthMap& map) {
  v1::DepthMap proto;
  proto.set_face_px(static_cast<uint32_t>(map.face_px));
  proto.set_known(PackMask(map));
  proto.set_ranges(PackKnown(map, map.range_m));
  proto.set_normals(PackKnown(map, map.normals));
  proto.set_sigmas(PackKnown(map, map.sigma_m));
  proto.set_views(PackKnown(map, map.views));
  proto.set_flags(PackKnown(map, map.flags));
  proto.set_problem(map.problem);
  return codec::Serialize(proto, "depth map", codec::Empty::kIsLegal);
}

absl::StatusOr<DepthMap> DecodeDepthMap(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::DepthMap proto,
                            codec::Parse<v1::DepthMap>(bytes, "depth map", codec::Empty::kIsLegal));
  if (proto.face_px() > kMaxFace_px || NumPixels(proto.face_px()) > 8 * proto.known().size())
    return absl::DataLossError("depth map: its mask is of another size");
  const size_t n = NumPixels(proto.face_px());
  DepthMap map{.face_px = static_cast<int>(proto.face_px()), .problem = proto.problem()};
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<uint32_t> known, UnpackMask(proto.known(), n));
  map.range_m.resize(n);
  map.normals.resize(n);
  map.sigma_m.resize(n);
  map.views.resize(n);
  map.flags.resize(n);
  ORBWEAVE_RETURN_IF_ERROR(UnpackKnown(proto.ranges(), known, "ranges", map.range_m));
  ORBWEAVE_RETURN_IF_ERROR(UnpackKnown(proto.normals(), known, "normals", map.normals));
  ORBWEAVE_RETURN_IF_ERROR(UnpackKnown(proto.sigmas(), known, "sigmas", map.sigma_m));
  ORBWEAVE_RETURN_IF_ERROR(UnpackKnown(proto.views(), known, "views", map.views));
  ORBWEAVE_RETURN_IF_ERROR(UnpackKnown(proto.flags(), known, "flags", map.flags));
  for (const uint32_t i : known) {
    if (!IsPositive(map.range_m[i]) || !IsSigma(map.sigma_m[i]))
      return absl::DataLossError("depth map: a range or sigma that is none");
  }
  return map;
}

absl::StatusOr<std::string> EncodeSurfacePoints(const SurfacePoints& points) {
  v1::SurfacePoints proto;
  ToProto(points, &proto);
  return codec::Serialize(proto, "surface points", codec::Empty::kIsLegal);
}

absl::StatusOr<SurfacePoints> DecodeSurfacePoints(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const v1::SurfacePoints proto,
      codec::Parse<v1::SurfacePoints>(bytes, "surface points", codec::Empty::kIsLegal));
  return FromProto(proto);
}

absl::StatusOr<std::string> EncodeDenseTile(const DenseTile& tile) {
  v1::DenseTile proto;
  proto.set_x(tile.cell.x);
  proto.set_y(tile.cell.y);
  proto.set_piece(tile.piece);
  ToProto(tile.points, proto.mutable_points());
  return codec::Serialize(proto, "dense tile");
}

absl::StatusOr<DenseTile> DecodeDenseTile(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::DenseTile proto,
                            codec::Parse<v1::DenseTile>(bytes, "dense tile"));
  DenseTile tile{.cell = {proto.x(), proto.y()}, .piece = proto.piece()};
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::IsCellNumber(tile.cell.x) && codec::IsCellNumber(tile.cell.y),
                    "dense tile",
                    "its cell is nowhere"));
  ORBWEAVE_ASSIGN_OR_RETURN(tile.points, FromProto(proto.points()));
  return tile;
}

}  // namespace orbweave
