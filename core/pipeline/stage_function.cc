// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/stage_function.h"

#include <exception>
#include <new>

#include "absl/strings/str_cat.h"

namespace orbweave {

absl::StatusOr<TaskResult> CallStage(const StageLookup& stages,
                                     const TaskSpec& spec,
                                     BlobAccess& blobs,
                                     const StageContext& context) {
  const StageFunction* stage = stages(spec.stage);
  if (stage == nullptr)
    return absl::UnimplementedError(absl::StrCat("this build has no stage ", spec.stage));
  try {
    return (*stage)(spec, blobs, context);
  } catch (const std::bad_alloc&) {
    return absl::ResourceExhaustedError("out of memory");
  } catch (const std::exception& error) {
    return absl::InternalError(error.what());
  }
}

}  // namespace orbweave
