// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/pipeline_options.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  orbweave::CheckRoundTrip(
      orbweave::BytesOf(data, size),
      [](std::string_view text) { return orbweave::PipelineOptionsFromText(text, "file"); },
      orbweave::PipelineOptionsToText);
  return 0;
}
