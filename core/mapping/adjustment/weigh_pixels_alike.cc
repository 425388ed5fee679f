// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/weigh_pixels_alike.h"

#include <algorithm>

namespace orbweave {
namespace {

float PixelSigma(const ClusterImage& image) {
  return static_cast<float>(image.camera.AngleFromPixels(1.0));
}

bool IsAlike(const ClusterImage& image) {
  return std::ranges::all_of(image.sigma_rad,
                             [&](float sigma_rad) { return sigma_rad == PixelSigma(image); });
}

}  // namespace

std::optional<ClusterProblem> WeighPixelsAlike(const ClusterProblem& problem) {
  if (std::ranges::all_of(problem.images, IsAlike)) return std::nullopt;
  ClusterProblem alike = problem;
  for (ClusterImage& image : alike.images) std::ranges::fill(image.sigma_rad, PixelSigma(image));
  return alike;
}

}  // namespace orbweave
