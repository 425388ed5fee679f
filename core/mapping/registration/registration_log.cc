// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/registration_log.h"

namespace orbweave {
namespace {

std::string ReasonOf(RegistrationLoss loss) {
  switch (loss) {
    case RegistrationLoss::kNone:
      return "";
    case RegistrationLoss::kPoints:
      return "lost its points again in the adjustment";
    case RegistrationLoss::kScale:
      return "stood on a scale of its own in its model, as a wrong pair makes it";
    case RegistrationLoss::kCut:
      return "was cut off: what joins it to its model contradicts it, or does not tell how large "
             "either is beside the other";
  }
  return "";
}

}  // namespace

void ResetAttempts(RegistrationLog& log) {
  for (RegistrationRecord& record : log) {
    record.num_attempts = 0;
    record.visible_at_failure = 0;
    record.contradicted = false;
    record.obstacle = RegistrationObstacle::kNone;
  }
}

std::string ReasonOf(const RegistrationRecord& record, uint32_t needed_visible) {
  if (record.loss != RegistrationLoss::kNone) return ReasonOf(record.loss);
  if (record.contradicted) {
    return std::to_string(record.best_inliers) +
           " points put it where its GNSS position and those around it say that it is not: a "
           "place that looks alike, or wrong positions";
  }
  if (record.obstacle == RegistrationObstacle::kPairs) {
    return "strong pairs contradict where " + std::to_string(record.best_inliers) +
           " points put it, and do not hold it by themselves: a place that looks alike";
  }
  if (record.obstacle == RegistrationObstacle::kLength) {
    return std::to_string(record.best_inliers) +
           " points agree, but do not tell how far it is from the others";
  }
  if (record.best_inliers < record.needed_inliers) {
    return std::to_string(record.best_inliers) + " of " + std::to_string(record.needed_inliers) +
           " needed points agree";
  }
  if (record.obstacle == RegistrationObstacle::kUnheld)
    return "its pairs say in which direction it lies from the others, but not how far";
  if (record.best_visible >= needed_visible && needed_visible > 0) {
    return "sees " + std::to_string(record.best_visible) +
           " reconstructed points of models that did not last, or that hold it nowhere";
  }
  if (record.best_visible > 0) {
    return "sees " + std::to_string(record.best_visible) + " of " + std::to_string(needed_visible) +
           " needed reconstructed points";
  }
  return "no pair of its images could start a reconstruction";
}

}  // namespace orbweave
