// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

#include "core/pipeline/view_progress.h"

namespace orbweave {

/// "3 s", "4 min 05 s", "2 h 10 min".
[[nodiscard]] std::string FormatDuration(double seconds);

/// Shows a job on `out`: one line that is rewritten on a terminal, a plain line now and then
/// elsewhere.
class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* out);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void Update(const JobStatus& status);
  /// Ends the rewritten line, so that other text can follow.
  void Finish();

 private:
  [[nodiscard]] bool IsWorthALine(const ProgressView& view, double elapsed_s) const;

  std::FILE* out_;
  bool is_terminal_;
  bool line_is_open_ = false;
  std::string last_stage_;
  double last_line_s_ = 0.0;
};

}  // namespace orbweave
