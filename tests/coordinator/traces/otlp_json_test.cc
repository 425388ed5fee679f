// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/otlp_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace orbweave {
namespace {

using Json = nlohmann::json;

const TraceSpan kSpan{.trace_id = std::string(32, 'a'),
                      .id = 0x1f,
                      .parent_id = "00000000000000b0",
                      .name = "square",
                      .start_ns = 1'700'000'000'000'000'001,
                      .end_ns = 1'700'000'000'000'000'002,
                      .texts = {{"orbweave.stage", "square"}},
                      .numbers = {{"orbweave.epoch", 1ULL << 60}},
                      .error = "why"};

TEST(OtlpJson, IsWhatTheProtocolWants) {
  const Json request = Json::parse(OtlpJson({kSpan}, "1.2"));
  const Json& resource = request.at("resourceSpans").at(0);
  EXPECT_EQ(resource.at("resource").at("attributes").at(0),
            Json::parse(R"({"key":"service.name","value":{"stringValue":"orbweave"}})"));
  const Json expected = Json::parse(R"({
      "traceId": "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", "spanId": "000000000000001f",
      "parentSpanId": "00000000000000b0", "name": "square", "kind": 1,
      "startTimeUnixNano": "1700000000000000001", "endTimeUnixNano": "1700000000000000002",
      "attributes": [{"key": "orbweave.stage", "value": {"stringValue": "square"}},
                     {"key": "orbweave.epoch", "value": {"intValue": "1152921504606846976"}}],
      "status": {"code": 2, "message": "why"}})");
  EXPECT_EQ(resource.at("scopeSpans").at(0).at("spans"), Json::array({expected}));
}

TEST(OtlpJson, LeavesOutWhatThereIsNot) {
  TraceSpan span = kSpan;
  span.parent_id.clear();
  span.error.reset();
  const Json json =
      Json::parse(OtlpJson({span}, "1")).at("resourceSpans").at(0).at("scopeSpans").at(0);
  EXPECT_FALSE(json.at("spans").at(0).contains("parentSpanId"));
  EXPECT_FALSE(json.at("spans").at(0).contains("status"));
}

TEST(OtlpJson, IsJsonWhateverStrangersWrote) {
  TraceSpan span = kSpan;
  span.texts["orbweave.label"] = "\"}\n\x01\xff\xc2";
  const std::string text = OtlpJson({span}, "1");
  EXPECT_TRUE(Json::accept(text));
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(RejectedSpans, AreReadFromAnAnswer) {
  EXPECT_EQ(RejectedSpans(R"({"partialSuccess":{"rejectedSpans":"3","errorMessage":"x"}})"), 3U);
  EXPECT_EQ(RejectedSpans(R"({"partialSuccess":{"rejectedSpans":4}})"), 4U);
  for (const char* answer : {"",
                             "{}",
                             "[]",
                             "null",
                             R"({"partialSuccess":{}})",
                             R"({"partialSuccess":7})",
                             R"({"partialSuccess":{"rejectedSpans":-1}})",
                             R"({"partialSuccess":{"rejectedSpans":"-1"}})",
                             R"({"partialSuccess":{"rejectedSpans":[3]}})",
                             "{\"partialSuccess\":"}) {
    EXPECT_EQ(RejectedSpans(answer), 0U) << answer;
  }
}

}  // namespace
}  // namespace orbweave
