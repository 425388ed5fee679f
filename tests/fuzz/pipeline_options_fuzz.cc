// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/pipeline_options.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(pipeline_options) {
  orbweave::CheckRoundTrip(
      orbweave::BytesOf(data, size),
      [](std::string_view text) { return orbweave::PipelineOptionsFromText(text, "file"); },
      orbweave::PipelineOptionsToText);
}
