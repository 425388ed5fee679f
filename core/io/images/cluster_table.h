// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace orbweave {

/// Clusters by hand: the name of each image's cluster, by the image's name.
using ClusterNames = std::map<std::string, std::string>;

/// Reads clusters by hand for the images of these names: comma-separated text whose header names
/// the columns `name` and `cluster` (any order and case, others ignored), one row per image. Rows
/// mean images as MatchNames says. `source` names the table in messages. InvalidArgument: a column
/// is missing, a row has no cluster or names an image again, rows that mean no image, images
/// without a row.
[[nodiscard]] absl::StatusOr<ClusterNames> ReadClusterTable(
    std::string_view text, const std::string& source, const std::vector<std::string>& image_names);

}  // namespace orbweave
