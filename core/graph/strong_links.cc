// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/strong_links.h"

#include <algorithm>

namespace orbweave {
namespace {

constexpr double kWeak = 0.1;

}  // namespace

StrongLinks::StrongLinks(const Adjacency& adjacency, std::span<const double> edge_weight)
    : edge_weight_(edge_weight), strongest_(adjacency.num_images(), 0.0) {
  for (uint32_t image = 0; image < adjacency.num_images(); ++image) {
    for (const Adjacency::Link& link : adjacency.Of(image))
      strongest_[image] = std::max(strongest_[image], edge_weight_[link.edge]);
  }
}

bool StrongLinks::Has(uint32_t image, const Adjacency::Link& link) const {
  return edge_weight_[link.edge] >= kWeak * std::min(strongest_[image], strongest_[link.image]);
}

}  // namespace orbweave
