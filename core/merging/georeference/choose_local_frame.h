// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/sim3.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// A frame for a model that no positions tie to the earth: upright where gravity is known (z up),
/// and then with y to the north where stated headings agree on it (TurnToHeadings); the first
/// image's centre at the median GNSS position (the origin without GNSS), and scaled so that the
/// median distance of consecutive images is 1. Scale is arbitrary, and so is what else is not
/// known.
[[nodiscard]] Sim3 ChooseLocalFrame(const Reconstruction& reconstruction,
                                    const ImageManifest& manifest);

}  // namespace orbweave
