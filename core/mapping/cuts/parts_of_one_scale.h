// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// The registered images in parts each of which is of one scale. What three images a, b, c all see
/// says how long b-c is in units of a-b; without such points what lies behind b has any size,
/// however many points it sees by itself and has in common with b: the triplets of a view graph
/// carry its scale (Jiang, Cui and Tan, A Global Linear Method for Camera Pose Registration, ICCV
/// 2013, section 4). Far away, or straight ahead, a point has no depth to tell: counted are points
/// that each two of the three see under two thirds of options.min_angle_deg at least. Images that
/// stand nearer to each other than a fifth of that are one (Stations): fifty at a traffic light see
/// what is before it and behind it together, each hardly a point.
///
/// The baselines of three images are of one scale where kFewestThatTellSize points tell, and so are
/// those of two parts that have two images in common. An image in which two parts hinge is of the
/// larger one. What would be a part of fewer than options.min_component_images stays with the part
/// that it has most points in common with: it is told (HingeFinder), and better than nothing.
///
/// In 23 of 23 right models of rendered streets (2 to 12 m, docs/hard_cases.md) all is one part,
/// for 15 to 20 points and half a degree to a degree and a half alike; three of nine that were off
/// by metres, or by a factor, are several, and so were 88 panoramas of a town.
///
/// The most images first, of equal ones the lowest; ascending.
[[nodiscard]] std::vector<std::vector<ImageSlot>> PartsOfOneScale(const MappingState& state,
                                                                  const MappingOptions& options);

}  // namespace orbweave
