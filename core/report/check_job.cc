// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_job.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "core/report/borne_out_by_gnss.h"
#include "core/report/check_contradicted_pairs.h"
#include "core/report/check_converged.h"
#include "core/report/check_coverage.h"
#include "core/report/check_gnss_use.h"
#include "core/report/check_hinges.h"
#include "core/report/check_lengths.h"
#include "core/report/check_look_alikes.h"
#include "core/report/check_pairs.h"
#include "core/report/check_seams.h"
#include "core/report/check_standing_camera.h"
#include "core/report/check_stretches.h"
#include "core/report/check_told_steps.h"

namespace orbweave {
namespace {

using Checks = std::vector<CrossCheck>;

void AddIfAny(std::optional<CrossCheck> check, Checks& checks) {
  if (check) checks.push_back(*std::move(check));
}

void AddChecksOfClusters(const JobResults& results,
                         const JobReport& report,
                         const PairsOfJob& judged,
                         const BorneOutByGnss& gnss,
                         Checks& checks) {
  checks.push_back(CheckPairs(results, judged, gnss));
  checks.push_back(CheckLengths(results));
  checks.push_back(CheckToldSteps(results));
  checks.push_back(CheckHinges(results));
  checks.push_back(CheckStretches(results));
  AddIfAny(CheckStandingCamera(results, report.images), checks);
  checks.push_back(CheckLookAlikes(results));
}

/// Those that a model was adjusted with.
void AddChecksOfModel(const JobResults& results,
                      const JobReport& report,
                      size_t number,
                      Checks& checks) {
  const bool is_small = 20 * report.each_model[number].images < report.registered;
  for (CrossCheck check : results.models[number].report.checks) {
    if (is_small) check.level = std::min(check.level, CheckLevel::kDoubtful);
    if (results.models.size() > 1 && !check.sentence.starts_with("model "))
      check.sentence = "model " + std::to_string(number) + ": " + check.sentence;
    checks.push_back(std::move(check));
  }
}

void AddChecksOfWhole(const JobResults& results, const JobReport& report, Checks& checks) {
  checks.push_back(CheckRegistered(report));
  AddIfAny(CheckFrames(report), checks);
  AddIfAny(CheckConnected(results, report), checks);
  AddIfAny(CheckSeamFits(report), checks);
  AddIfAny(CheckSeamsInLoops(report), checks);
  AddIfAny(CheckCertified(report), checks);
  AddIfAny(CheckConverged(results), checks);
  AddIfAny(CheckUncertainty(report), checks);
  for (size_t model = 0; model < results.models.size(); ++model)
    AddIfAny(CheckGnssUse(results, report, model), checks);
}

}  // namespace

std::vector<CrossCheck> CheckJob(const JobResults& results, const JobReport& report) {
  const BorneOutByGnss gnss(results);
  const PairsOfJob judged = JudgePairsOfJob(results);
  Checks checks;
  AddChecksOfClusters(results, report, judged, gnss, checks);
  for (size_t number = 0; number < results.models.size(); ++number)
    AddChecksOfModel(results, report, number, checks);
  if (std::ranges::find(checks, "pairs_contradicted", &CrossCheck::name) == checks.end())
    AddIfAny(CheckContradictedPairs(results, judged, gnss), checks);
  AddChecksOfWhole(results, report, checks);
  return checks;
}

}  // namespace orbweave
