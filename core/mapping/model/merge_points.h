// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Unites each of `points` with points that its features match, where one position explains all
/// observations of both within `max_error_px`: the mean weighted by track lengths, or the point
/// triangulated from all rays. Of two features of one image (a keypoint found twice) the better
/// stays. Returns the number of points that went up in others.
uint32_t MergePoints(MappingState& state, std::span<const PointIndex> points, double max_error_px);

/// The same for two given points: the point they became, kNoPoint where nothing explains both.
PointIndex MergePair(MappingState& state, PointIndex a, PointIndex b, double max_error_px);

}  // namespace orbweave
