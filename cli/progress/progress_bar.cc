// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/progress/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

std::string FormatView(const ProgressView& view) {
  if (view.stage.empty()) return "done";
  std::string text = absl::StrFormat("%s %.*f/%u",
                                     PrintableText(view.stage),
                                     view.tasks_total < 10 && view.tasks_total > 0 ? 1 : 0,
                                     view.tasks_done,
                                     view.tasks_total);
  if (view.tasks_per_s > 0.0)
    absl::StrAppend(&text, absl::StrFormat("  %.2g tasks/s", view.tasks_per_s));
  if (view.eta_s >= 0.0) absl::StrAppend(&text, "  about ", FormatDuration(view.eta_s), " left");
  return text;
}

std::string Bar(double fraction) {
  constexpr size_t kWidth = 30;
  const auto filled = static_cast<size_t>(std::lround(fraction * kWidth));
  return absl::StrCat("[", std::string(filled, '#'), std::string(kWidth - filled, '.'), "]");
}

}  // namespace

std::string FormatDuration(double seconds) {
  const auto whole = static_cast<int64_t>(std::llround(std::max(0.0, seconds)));
  if (whole < 60) return absl::StrFormat("%d s", whole);
  if (whole < 3600) return absl::StrFormat("%d min %02d s", whole / 60, whole % 60);
  return absl::StrFormat("%d h %02d min", whole / 3600, whole % 3600 / 60);
}

ProgressBar::ProgressBar(std::FILE* out) : out_(out), is_terminal_(::isatty(::fileno(out)) == 1) {}

ProgressBar::~ProgressBar() { Finish(); }

void ProgressBar::Update(const JobStatus& status) {
  const ProgressView view = ViewProgress(status);
  const std::string what =
      status.unmet.empty() ? FormatView(view) : "waits: " + PrintableText(status.unmet);
  const std::string percent = absl::StrFormat("%3.0f %%", 100.0 * view.fraction);
  if (is_terminal_) {
    std::fprintf(
        out_, "\r\033[K%s %s  %s", Bar(view.fraction).c_str(), percent.c_str(), what.c_str());
    line_is_open_ = true;
  } else if (IsWorthALine(view, status.elapsed_s)) {
    std::fprintf(out_,
                 "%s  %s  after %s\n",
                 percent.c_str(),
                 what.c_str(),
                 FormatDuration(status.elapsed_s).c_str());
    last_stage_ = view.stage;
    last_line_s_ = status.elapsed_s;
  }
  std::fflush(out_);
}

bool ProgressBar::IsWorthALine(const ProgressView& view, double elapsed_s) const {
  constexpr double kEvery_s = 15.0;
  return view.stage != last_stage_ || elapsed_s - last_line_s_ > kEvery_s;
}

void ProgressBar::Finish() {
  if (line_is_open_) std::fputc('\n', out_);
  line_is_open_ = false;
}

}  // namespace orbweave
