// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration_log.h"

namespace orbweave {

std::string ReasonOf(const RegistrationRecord& record, uint32_t needed_visible) {
  if (record.dropped) return "lost its points again in the adjustment";
  if (record.num_attempts > 0) {
    return std::to_string(record.best_inliers) + " of " + std::to_string(record.needed_inliers) +
           " needed points agree";
  }
  if (record.best_visible > 0) {
    return "sees " + std::to_string(record.best_visible) + " of " + std::to_string(needed_visible) +
           " needed reconstructed points";
  }
  return "no pair of its images could start a reconstruction";
}

}  // namespace orbweave
