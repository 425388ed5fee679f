// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/otlp_json.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(collector_answer) { (void)orbweave::RejectedSpans(orbweave::BytesOf(data, size)); }
