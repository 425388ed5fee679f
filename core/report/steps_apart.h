// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/report/job_results.h"

namespace orbweave {

/// How far apart images stand in the finished models. Refers to the results.
class StepsApart {
 public:
  explicit StepsApart(const JobResults& results);

  /// The distance of the two centres in steps: the usual one (UsualStep) of those between images of
  /// that model whose numbers follow one another. nullopt where no model has both, or where one is
  /// loose.
  [[nodiscard]] std::optional<double> Between(const ImagePair& pair) const;
  /// The images of the model that has this one, which is one that is asked for above.
  [[nodiscard]] const std::map<ImageId, RegisteredImage>& ModelOf(ImageId image) const;

 private:
  const JobResults& results_;
  std::vector<int> model_of_image_;
  std::vector<double> step_;  ///< per model
};

}  // namespace orbweave
