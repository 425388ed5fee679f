// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/mapping/registration/register_image.h"

namespace orbweave {

/// How an image that was registered left its model.
enum class RegistrationLoss {
  kNone,
  kPoints,  ///< lost its points in an adjustment
  kScale,   ///< stood on a scale of its own (DropOffScaleImages)
  kCut,     ///< in a piece of less than a model (CutAtHinges)
};

/// What was tried for one image, and what came of it.
struct RegistrationRecord {
  int num_attempts = 0;
  uint32_t visible_at_failure = 0;  ///< scene points it saw when it last failed
  uint32_t best_inliers = 0;        ///< most points that ever agreed
  uint32_t needed_inliers = 0;      ///< when most agreed
  uint32_t best_visible = 0;        ///< most points it ever saw
  int num_reconsidered = 0;         ///< times that it was registered anew (ReconsiderImages)
  RegistrationLoss loss = RegistrationLoss::kNone;
  bool contradicted = false;  ///< GNSS had the last word (RegistrationAttempt::waits)
  RegistrationObstacle obstacle = RegistrationObstacle::kNone;  ///< of the last attempt
};

/// One record per image of the cluster.
using RegistrationLog = std::vector<RegistrationRecord>;

/// Lets every image be tried anew.
void ResetAttempts(RegistrationLog& log);

/// Why an image that has verified matches is in no submodel: one sentence for the report.
[[nodiscard]] std::string ReasonOf(const RegistrationRecord& record, uint32_t needed_visible);

}  // namespace orbweave
