// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <mutex>
#include <string>

#include "core/base/stage_context.h"

namespace orbweave {

/// "images 17/90  2.1/s  about 35 s left"; without a total (0) "objects 4000  900/s". `elapsed_s`:
/// since the first `before` of them were done. What is left is told after a second.
[[nodiscard]] std::string FormatPreparation(const Progress& progress,
                                            uint64_t before,
                                            double elapsed_s);

/// Shows on `out` how far the images of a job are that are listed, read and offered: one line that
/// is rewritten on a terminal, elsewhere a line every quarter of a minute, none for what takes
/// less. Thread-safe.
class PreparationBar {
 public:
  explicit PreparationBar(std::FILE* out);
  ~PreparationBar();
  PreparationBar(const PreparationBar&) = delete;
  PreparationBar& operator=(const PreparationBar&) = delete;

  void Update(const Progress& progress);

 private:
  std::FILE* out_;
  bool is_terminal_;
  std::mutex mutex_;
  bool line_is_open_ = false;
  Progress first_{};  ///< of this counting
  uint64_t last_done_ = 0;
  double began_s_ = 0.0;  ///< counting it
  double shown_s_ = 0.0;  ///< the last time that it was
};

}  // namespace orbweave
