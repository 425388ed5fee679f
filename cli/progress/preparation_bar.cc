// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/progress/preparation_bar.h"

#include <unistd.h>

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "cli/progress/progress_bar.h"
#include "core/base/clock.h"

namespace orbweave {
namespace {

/// Between two lines: on a terminal, and elsewhere.
constexpr double kRewrite_s = 0.2;
constexpr double kLine_s = 15.0;

}  // namespace

std::string FormatPreparation(const Progress& progress, uint64_t before, double elapsed_s) {
  std::string text = absl::StrCat(progress.unit, " ", progress.done);
  if (progress.total > 0) absl::StrAppend(&text, "/", progress.total);
  if (elapsed_s < 1.0 || progress.done <= before) return text;
  const double per_s = static_cast<double>(progress.done - before) / elapsed_s;
  const std::string rate =
      per_s < 10.0 ? absl::StrFormat("%.2g", per_s) : absl::StrFormat("%.0f", per_s);
  absl::StrAppend(&text, "  ", rate, "/s");
  if (progress.done < progress.total) {
    const auto left = static_cast<double>(progress.total - progress.done);
    absl::StrAppend(&text, "  about ", FormatDuration(left / per_s), " left");
  }
  return text;
}

PreparationBar::PreparationBar(std::FILE* out)
    : out_(out), is_terminal_(::isatty(::fileno(out)) == 1) {}

PreparationBar::~PreparationBar() {
  if (line_is_open_) std::fputc('\n', out_);
}

void PreparationBar::Update(const Progress& progress) {
  const double now_s = SteadyClock().NowSeconds();
  const std::lock_guard lock(mutex_);
  if (progress.unit != first_.unit || progress.done < last_done_) {
    first_ = progress;
    began_s_ = now_s;
    if (shown_s_ == 0.0) shown_s_ = now_s;
  }
  last_done_ = progress.done;
  const bool is_last = is_terminal_ && line_is_open_ && progress.done == progress.total;
  if (!is_last && now_s - shown_s_ < (is_terminal_ ? kRewrite_s : kLine_s)) return;
  shown_s_ = now_s;
  const std::string text = FormatPreparation(progress, first_.done, now_s - began_s_);
  std::fprintf(out_, is_terminal_ ? "\r\033[K%s" : "%s\n", text.c_str());
  line_is_open_ = is_terminal_;
  std::fflush(out_);
}

}  // namespace orbweave
