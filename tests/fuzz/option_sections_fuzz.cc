// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_plan.h"
#include "stages/plans.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(option_sections) {
  const std::string_view text = orbweave::BytesOf(data, size);
  (void)orbweave::FindJobPlan(text);
  const std::vector<std::string> sections = {"align", "features"};
  const std::string selected = orbweave::SelectSections(text, sections);
  ORBWEAVE_CHECK(selected.size() <= text.size() + 1);
  ORBWEAVE_CHECK(orbweave::SelectSections(selected, sections) == selected);
}
