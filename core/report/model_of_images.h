// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/report/job_results.h"

namespace orbweave {

/// Model of each image of the manifest, -1 for none. Loose images are in none.
[[nodiscard]] std::vector<int> ModelOfImages(const JobResults& results);

/// Whether both images are in one model, by what ModelOfImages found.
[[nodiscard]] bool AreOfOneModel(const std::vector<int>& model_of_image, const ImagePair& pair);

}  // namespace orbweave
