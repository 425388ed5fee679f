// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/http_pages.h"

#include "absl/strings/str_cat.h"
#include "coordinator/metrics/metrics_text.h"

namespace orbweave {
namespace {

HttpPage PageOf(const absl::Status& status) {
  if (status.ok()) return {.body = "ok\n"};
  return {.status = 503, .body = absl::StrCat(status.message(), "\n")};
}

}  // namespace

HttpPages::HttpPages(Coordinator& coordinator,
                     const MetricsCounters& counters,
                     const Clock& clock,
                     ProbePatience patience)
    : coordinator_(coordinator),
      counters_(counters),
      clock_(clock),
      keep_s_(patience.keep_s),
      ready_([&coordinator] { return coordinator.CheckReady(); }, clock, patience) {}

template <typename Write>
const std::string& HttpPages::Fresh(Kept& kept, const Write& write) const {
  const double now_s = clock_.NowSeconds();
  if (kept.written_s && now_s - *kept.written_s < keep_s_) return kept.text;
  kept.text = write();
  kept.written_s = now_s;
  return kept.text;
}

std::optional<HttpPage> HttpPages::Find(std::string_view path) {
  if (path == "/metrics") {
    return HttpPage{
        .content_type = "text/plain; version=0.0.4; charset=utf-8",
        .body = Fresh(metrics_, [this] { return MetricsText(coordinator_, counters_); })};
  }
  if (path == "/wanted") {
    return HttpPage{
        .body = Fresh(wanted_, [this] { return absl::StrCat(coordinator_.SlotsWanted(), "\n"); })};
  }
  if (path == "/livez") return PageOf(coordinator_.CheckLive());
  if (path == "/readyz") return PageOf(ready_.Ask());
  return std::nullopt;
}

}  // namespace orbweave
