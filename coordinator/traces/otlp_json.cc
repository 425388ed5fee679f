// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/otlp_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kInternal = 1;  // Span.SpanKind
constexpr int kError = 2;     // Status.StatusCode

Json TextAttribute(std::string_view key, std::string_view value) {
  return {{"key", key}, {"value", {{"stringValue", value}}}};
}

/// 64-bit numbers are strings in protobuf's JSON.
Json NumberAttribute(std::string_view key, uint64_t value) {
  return {{"key", key}, {"value", {{"intValue", absl::StrCat(value)}}}};
}

Json JsonOf(const TraceSpan& span) {
  Json attributes = Json::array();
  for (const auto& [key, value] : span.texts) attributes.push_back(TextAttribute(key, value));
  for (const auto& [key, value] : span.numbers) attributes.push_back(NumberAttribute(key, value));
  Json json = {{"traceId", span.trace_id},
               {"spanId", SpanIdText(span.id)},
               {"name", span.name},
               {"kind", kInternal},
               {"startTimeUnixNano", absl::StrCat(span.start_ns)},
               {"endTimeUnixNano", absl::StrCat(span.end_ns)},
               {"attributes", std::move(attributes)}};
  if (!span.parent_id.empty()) json["parentSpanId"] = span.parent_id;
  if (span.error) json["status"] = {{"code", kError}, {"message", *span.error}};
  return json;
}

}  // namespace

std::string OtlpJson(const std::vector<TraceSpan>& spans, std::string_view version) {
  Json list = Json::array();
  for (const TraceSpan& span : spans) list.push_back(JsonOf(span));
  const Json resource = {{"attributes",
                          Json::array({TextAttribute("service.name", "orbweave"),
                                       TextAttribute("service.version", version)})}};
  const Json scope = {{"scope", {{"name", "orbweave"}}}, {"spans", std::move(list)}};
  const Json request = {
      {"resourceSpans",
       Json::array({{{"resource", resource}, {"scopeSpans", Json::array({scope})}}})}};
  return request.dump(-1, ' ', true, Json::error_handler_t::replace);
}

uint64_t RejectedSpans(std::string_view answer) {
  const Json json = Json::parse(answer, nullptr, false);
  const Json::json_pointer where("/partialSuccess/rejectedSpans");
  if (json.is_discarded() || !json.contains(where)) return 0;
  const Json& rejected = json.at(where);
  if (rejected.is_number_unsigned()) return rejected.get<uint64_t>();
  uint64_t number = 0;
  if (!rejected.is_string() || !absl::SimpleAtoi(rejected.get<std::string>(), &number)) return 0;
  return number;
}

}  // namespace orbweave
