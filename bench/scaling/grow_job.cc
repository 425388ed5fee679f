// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/grow_job.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

PartLoad SumOf(const std::vector<PartLoad>& parts) {
  PartLoad sum;
  for (const PartLoad& part : parts) {
    sum.compute_s += part.compute_s;
    sum.bytes += part.bytes;
  }
  return sum;
}

double Ratio(double wanted, double present) { return present > 0.0 ? wanted / present : 1.0; }

StageLoad GrowRun(const StageLoad& run, double factor, const StageGrowth& growth) {
  const auto count = static_cast<double>(run.parts.size());
  const size_t parts = run.parts.size() < 2
                           ? run.parts.size()
                           : static_cast<size_t>(std::max(1.0, std::round(count * factor)));
  StageLoad grown{.stage = run.stage, .needs = run.needs};
  for (size_t part = 0; part < parts; ++part)
    grown.parts.push_back(run.parts[part % run.parts.size()]);
  const PartLoad before = SumOf(run.parts);
  const PartLoad repeated = SumOf(grown.parts);
  const double compute =
      Ratio(before.compute_s * std::pow(factor, growth.compute), repeated.compute_s);
  const double bytes = Ratio(before.bytes * std::pow(factor, growth.bytes), repeated.bytes);
  for (PartLoad& part : grown.parts) {
    part.compute_s *= compute;
    part.bytes *= bytes;
  }
  return grown;
}

}  // namespace

std::vector<StageLoad> GrowJob(const std::vector<StageLoad>& runs,
                               double factor,
                               const std::map<std::string, StageGrowth>& growth) {
  std::vector<StageLoad> grown;
  for (const StageLoad& run : runs) {
    const auto found = growth.find(run.stage);
    grown.push_back(GrowRun(run, factor, found == growth.end() ? StageGrowth{} : found->second));
  }
  return grown;
}

}  // namespace orbweave
