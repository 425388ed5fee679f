// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "absl/status/status.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// What is known of a job before it is submitted.
struct JobShape {
  size_t num_images = 0;            ///< that may take part
  size_t num_clusters_by_hand = 0;  ///< 0: clusters are made automatically
  bool has_matches = false;         ///< from a database: nothing is extracted, paired or matched
};

/// InvalidArgument where options, each within its range, cannot work together or with the job: it
/// would fail at its end, or one of them would do nothing without a word. The message names the
/// options and says what to do.
/// A job on images may go on to a cloud (`run --dense`): what that reads is looked at too.
[[nodiscard]] absl::Status CheckOptionsTogether(const PipelineOptions& options,
                                                const JobShape& job);

/// The same of what dense jobs alone read.
[[nodiscard]] absl::Status CheckDenseOptions(const SourceOptions& options);

}  // namespace orbweave
