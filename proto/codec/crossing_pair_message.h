// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <vector>

#include "absl/status/statusor.h"
#include "core/scene/view_graph.h"
#include "orbweave/v1/artifacts.pb.h"

/// A message that partitions and results of clusters hold.

namespace orbweave::codec {

using CrossingPairMessages = google::protobuf::RepeatedPtrField<v1::CrossingPair>;

void ToProto(const std::vector<CrossingPair>& pairs, CrossingPairMessages* proto);
/// DataLoss unless each is of two images in order and leads in a direction, or nowhere.
[[nodiscard]] absl::StatusOr<std::vector<CrossingPair>> FromProto(
    const CrossingPairMessages& proto);

}  // namespace orbweave::codec
