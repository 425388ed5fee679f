// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traceparent.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(traceparent) {
  const auto parsed = orbweave::ParseTraceparent(orbweave::BytesOf(data, size));
  if (!parsed.ok()) return;
  const auto again = orbweave::ParseTraceparent("00-" + parsed->trace_id + "-" + parsed->parent_id +
                                                (parsed->is_sampled ? "-01" : "-00"));
  ORBWEAVE_CHECK(again.ok() && again->trace_id == parsed->trace_id &&
                 again->parent_id == parsed->parent_id && again->is_sampled == parsed->is_sampled);
}
