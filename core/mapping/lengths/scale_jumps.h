// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "core/mapping/lengths/asked_rays.h"

namespace orbweave {

/// By how much the scale jumps at each way from a registered image of a line (FindStreetLines) to
/// the next, by that image: |log| of the ratio of its two sides. What is on either side of a way
/// may be right in itself and stand on a scale of its own, where hardly a ray tells how long the
/// way is: in models of one rendered street without GNSS what lay behind such a way was 11, 40 and
/// 14,000 times too small.
///
/// The scale shows in how long steps are, the median of three, and in how far away what panoramas
/// see is, the median of three of the median reach of an image's rays. A camera that slows down, or
/// enters a lane, changes one of them; the jump is the smaller of both, 0 where they contradict
/// each other or a side tells nothing.
[[nodiscard]] std::map<ImageSlot, double> MeasureScaleJumps(const AskedRays& asked);

}  // namespace orbweave
