// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/partitioned_ba/global_options.h"
#include "core/scene/reconstruction.h"
#include "orbweave/v1/artifacts.pb.h"
#include "proto/codec/pack.h"

/// Messages that several artifacts hold.

namespace orbweave::codec {

using Vector3Bytes = std::array<double, 3>;
using PoseBytes = std::array<double, 7>;  ///< qw qx qy qz, a vector

inline Vector3Bytes ToArray(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d ToVector(const Vector3Bytes& a) { return {a[0], a[1], a[2]}; }

[[nodiscard]] std::string PackVectors(const std::vector<Eigen::Vector3d>& vectors);
/// DataLoss also for what is no number.
[[nodiscard]] absl::StatusOr<std::vector<Eigen::Vector3d>> UnpackVectors(const std::string& bytes,
                                                                         const char* what);

void ToProto(const Reconstruction& reconstruction, v1::Reconstruction* proto);
[[nodiscard]] absl::StatusOr<Reconstruction> FromProto(const v1::Reconstruction& proto);

void ToProto(const GnssReport& gnss, v1::GnssReport* proto);
[[nodiscard]] absl::StatusOr<GnssReport> FromProto(const v1::GnssReport& proto);

void ToProto(const UncertaintyReport& report, v1::UncertaintyReport* proto);
[[nodiscard]] absl::StatusOr<UncertaintyReport> FromProto(const v1::UncertaintyReport& proto);

void ToProto(const BundleReport& report, v1::BundleReport* proto);
[[nodiscard]] absl::StatusOr<BundleReport> FromProto(const v1::BundleReport& proto);

}  // namespace orbweave::codec
