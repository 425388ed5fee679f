// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/model_of_images.h"

namespace orbweave {

std::vector<int> ModelOfImages(const JobResults& results) {
  std::vector<int> model_of_image(results.manifest.images.size(), -1);
  for (size_t model = results.models.size(); model-- > 0;) {
    for (const auto& [id, image] : results.models[model].images) {
      if (!image.loose && id.value < model_of_image.size())
        model_of_image[id.value] = static_cast<int>(model);
    }
  }
  return model_of_image;
}

bool AreOfOneModel(const std::vector<int>& model_of_image, const ImagePair& pair) {
  const size_t size = model_of_image.size();
  return pair.a.value < size && pair.b.value < size && model_of_image[pair.a.value] >= 0 &&
         model_of_image[pair.a.value] == model_of_image[pair.b.value];
}

}  // namespace orbweave
