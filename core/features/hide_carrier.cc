// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/hide_carrier.h"

#include <algorithm>

#include "core/geometry/sphere_cells.h"

namespace orbweave {

std::span<const uint32_t> CellsOfCarrier(std::span<const Carrier> carriers, ImageId image) {
  for (const Carrier& carrier : carriers)
    if (std::ranges::binary_search(carrier.images, image)) return carrier.cells;
  return {};
}

SceneFeatures HideCarrier(const Features& features, std::span<const uint32_t> cells) {
  SceneFeatures scene{.features = {.camera = features.camera, .problem = features.problem}};
  Features& left = scene.features;
  for (FeatureIndex i = 0; i < features.size(); ++i) {
    if (std::ranges::binary_search(cells, SphereCell(features.Bearing(i), kCarrierCells))) continue;
    scene.index.push_back(i);
    left.keypoints.push_back(features.keypoints[i]);
    left.sigma_rad.push_back(features.sigma_rad[i]);
    left.colors.push_back(features.colors[i]);
    if (!features.view.empty()) left.view.push_back(features.view[i]);
    if (features.descriptors.empty()) continue;
    const uint8_t* const descriptor = features.Descriptor(i);
    left.descriptors.insert(left.descriptors.end(), descriptor, descriptor + kDescriptorSize);
  }
  return scene;
}

}  // namespace orbweave
