// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/traces/job_spans.h"

namespace orbweave {

/// An ExportTraceServiceRequest of OTLP as JSON (opentelemetry-proto 1.x, collector/trace/v1),
/// from the service "orbweave" of this version.
[[nodiscard]] std::string OtlpJson(const std::vector<TraceSpan>& spans, std::string_view version);

/// How many spans a collector refused, by its answer; 0 when it does not say so.
[[nodiscard]] uint64_t RejectedSpans(std::string_view answer);

}  // namespace orbweave
