// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/dense/depth_map.h"
#include "core/geometry/rigid3.h"
#include "core/scene/ids.h"

namespace orbweave {

/// The depth map of a panorama, and where it stood.
struct PosedDepthMap {
  ImageId image{};
  const DepthMap* map = nullptr;
  Rigid3 cam_from_world{};
};

}  // namespace orbweave
