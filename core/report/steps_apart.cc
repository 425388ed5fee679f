// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/steps_apart.h"

#include <utility>

#include "core/report/model_of_images.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

using Images = std::map<ImageId, RegisteredImage>;

Eigen::Vector3d CentreOf(const Images& images, ImageId id) {
  return images.at(id).cam_from_world.Centre();
}

double StepOf(const Images& images) {
  std::vector<double> steps;
  std::optional<ImageId> before;
  for (const auto& [id, image] : images) {
    if (image.loose) continue;
    if (before) steps.push_back((CentreOf(images, id) - CentreOf(images, *before)).norm());
    before = id;
  }
  return UsualStep(std::move(steps));
}

}  // namespace

StepsApart::StepsApart(const JobResults& results)
    : results_(results), model_of_image_(ModelOfImages(results)) {
  for (const AdjustedModel& model : results.models) step_.push_back(StepOf(model.images));
}

std::optional<double> StepsApart::Between(const ImagePair& pair) const {
  if (!AreOfOneModel(model_of_image_, pair)) return std::nullopt;
  const Images& images = ModelOf(pair.a);
  const double step = step_[static_cast<size_t>(model_of_image_[pair.a.value])];
  return (CentreOf(images, pair.b) - CentreOf(images, pair.a)).norm() / step;
}

const Images& StepsApart::ModelOf(ImageId image) const {
  return results_.models[static_cast<size_t>(model_of_image_[image.value])].images;
}

}  // namespace orbweave
