// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_api.h"

#include "core/pipeline/job_plan.h"

namespace orbweave {

Digest JobSpec::Id() const {
  return DigestBuilder()
      .AddField("orbweave job")
      .AddField(kind)
      .AddField(options_text)
      .AddField(EncodeCollection(inputs))
      .Finish();
}

std::string_view JobStateName(JobState state) {
  switch (state) {
    case JobState::kRunning:
      return "running";
    case JobState::kDone:
      return "done";
    case JobState::kFailed:
      return "failed";
    case JobState::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

}  // namespace orbweave
