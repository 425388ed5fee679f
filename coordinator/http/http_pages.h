// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "coordinator/coordinator.h"
#include "coordinator/http/http_server.h"
#include "coordinator/http/kept_probe.h"
#include "coordinator/metrics/metrics_counters.h"
#include "core/base/clock.h"

namespace orbweave {

/// What a coordinator shows over HTTP. Each page is kept for `keep_s`, so that who asks often costs
/// the coordinator no more:
///   /metrics  for Prometheus (metrics_text.h)
///   /livez    200, or 503 and why: Coordinator::CheckLive. Who gets 503 for long may restart it.
///   /readyz   200, or 503 and why: Coordinator::CheckReady, by a KeptProbe
///   /wanted   a number: Coordinator::SlotsWanted
class HttpPages {
 public:
  /// What it is given outlives it.
  HttpPages(Coordinator& coordinator,
            const MetricsCounters& counters,
            const Clock& clock,
            ProbePatience patience = {});

  /// An HttpPageLookup.
  [[nodiscard]] std::optional<HttpPage> Find(std::string_view path);

 private:
  struct Kept {
    std::optional<double> written_s{};
    std::string text{};
  };
  /// As it is kept, or written anew.
  template <typename Write>
  [[nodiscard]] const std::string& Fresh(Kept& kept, const Write& write) const;

  Coordinator& coordinator_;
  const MetricsCounters& counters_;
  const Clock& clock_;
  double keep_s_;
  Kept metrics_;
  Kept wanted_;
  KeptProbe ready_;
};

}  // namespace orbweave
