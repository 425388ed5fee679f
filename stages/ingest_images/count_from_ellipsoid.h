// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "absl/status/status.h"
#include "core/io/gnss/geoid_heights.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Turns altitudes of geodetic positions that are counted from `datum` into heights above the
/// ellipsoid; those of `of_ellipsoid` are that already, and those that are not finite (nobody knows
/// them) stay. Warns where there is nothing to turn. `folder` and codes of GeoidHeights.
[[nodiscard]] absl::Status CountFromEllipsoid(HeightDatum datum,
                                              const std::set<ImageId>& of_ellipsoid,
                                              ImageManifest& manifest,
                                              const std::string& folder = "");

}  // namespace orbweave
