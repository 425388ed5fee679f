// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "stages/pipeline_options.h"

namespace orbweave {

/// What a preset of the mapper asks of the stages around it, as "section.key=value".
[[nodiscard]] std::vector<std::string> AssignmentsOf(MappingPreset preset);

/// The defaults under a preset: those of PipelineOptions, then AssignmentsOf.
[[nodiscard]] PipelineOptions DefaultsOf(MappingPreset preset);

/// Options from a file's text (`source` names it in errors; may be empty) and then `assignments`,
/// over the defaults of the preset that these choose, wherever they do: what somebody sets counts,
/// whether before the preset or after it. Errors as of SetPipelineOption.
[[nodiscard]] absl::StatusOr<PipelineOptions> OptionsOverPreset(
    std::string_view text, std::string_view source, const std::vector<std::string>& assignments);

}  // namespace orbweave
