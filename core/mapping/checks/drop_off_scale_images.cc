// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/drop_off_scale_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/quantile.h"
#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

const double kLogOtherScale = std::log(32.0);

/// Logarithms per registered image, in their order.
struct Scales {
  std::vector<double> steps{};
  std::vector<double> reaches{};
};

double StepOf(const MappingState& state, ImageSlot image) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const uint32_t p : state.Graph().pairs_of_image[image]) {
    const ImageSlot other = state.Graph().pairs[p].Other(image);
    if (state.IsRegistered(other))
      nearest = std::min(nearest, (state.Centre(other) - state.Centre(image)).norm());
  }
  return nearest;
}

Scales MeasureScales(const MappingState& state) {
  std::vector<std::vector<double>> distances(state.Graph().NumImages());
  for (PointIndex p = 0; p < state.EndOfPoints(); ++p) {
    for (const ImageSlot image : ImagesThatSee(state, p))
      distances[image].push_back((state.Point(p).position - state.Centre(image)).norm());
  }
  Scales scales;
  for (const ImageSlot image : state.Registered()) {
    std::vector<double>& reaches = distances[image];
    scales.steps.push_back(std::log(StepOf(state, image)));
    scales.reaches.push_back(reaches.empty() ? scales.steps.back()
                                             : std::log(Quantile(std::move(reaches), 0.5)));
  }
  return scales;
}

/// All but the most images that common points join.
std::vector<ImageSlot> ImagesBesideLargestPart(const MappingState& state) {
  DisjointSets joined(state.Graph().NumImages());
  for (PointIndex p = 0; p < state.EndOfPoints(); ++p) {
    const std::vector<ImageSlot> images = ImagesThatSee(state, p);
    for (size_t i = 1; i < images.size(); ++i) joined.Unite(images[0], images[i]);
  }
  const std::vector<std::vector<ImageSlot>> parts = joined.SetsOf(state.Registered());
  std::vector<ImageSlot> others;
  for (size_t part = 1; part < parts.size(); ++part)
    others.insert(others.end(), parts[part].begin(), parts[part].end());
  return others;
}

}  // namespace

std::vector<ImageSlot> ImagesOffScale(const MappingState& state) {
  const Scales scales = MeasureScales(state);
  const double step = Quantile(scales.steps, 0.5);
  const double reach = Quantile(scales.reaches, 0.5);
  std::vector<ImageSlot> shrunk;
  std::vector<ImageSlot> grown;
  for (size_t i = 0; i < state.Registered().size(); ++i) {
    const auto [less, more] = std::minmax({scales.steps[i] - step, scales.reaches[i] - reach});
    if (more < -kLogOtherScale) shrunk.push_back(state.Registered()[i]);
    if (less > kLogOtherScale) grown.push_back(state.Registered()[i]);
  }
  const bool has_both = !shrunk.empty() && !grown.empty();
  if (has_both) return shrunk.size() <= grown.size() ? shrunk : grown;
  return shrunk.empty() ? grown : shrunk;
}

std::vector<ImageSlot> DropOffScaleImages(MappingState& state) {
  std::vector<ImageSlot> dropped = ImagesOffScale(state);
  if (dropped.empty()) return dropped;
  for (const ImageSlot image : dropped) state.Deregister(image);
  const std::vector<ImageSlot> beside = ImagesBesideLargestPart(state);
  for (const ImageSlot image : beside) state.Deregister(image);
  dropped.insert(dropped.end(), beside.begin(), beside.end());
  std::ranges::sort(dropped);
  return dropped;
}

}  // namespace orbweave
