// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "core/pipeline/stage_needs.h"

namespace orbweave {

struct StageFacts {
  std::string_view name;
  /// Of the algorithm; see StageRule::version. Whoever changes what the stage computes raises it.
  std::string_view version;
  /// What a run usually costs beside those of other stages: of a job on images, in percent.
  double weight;
  StageNeeds needs{};  ///< of one task
};

}  // namespace orbweave
