// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_lengths.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/mapping/find_length_faults.h"
#include "core/report/model_of_images.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

constexpr double kBadShare = 0.02;  // one in fifty, as in CheckSequenceSteps

/// Of pairs of images of one model, in order of pairs.
std::vector<PairLength> LengthsOf(const JobResults& results) {
  const std::vector<int> model_of_image = ModelOfImages(results);
  std::map<ImagePair, LengthAgreement> lengths;
  for (const ClusterSummary& cluster : results.clusters) {
    for (const auto& [pair, agreement] : cluster.pair_lengths) {
      if (!AreOfOneModel(model_of_image, pair)) continue;
      const auto [known, is_new] = lengths.try_emplace(pair, agreement);
      if (!is_new && agreement.Share() < known->second.Share()) known->second = agreement;
    }
  }
  std::vector<PairLength> sorted;
  for (const auto& [pair, agreement] : lengths) sorted.push_back({pair, agreement});
  return sorted;
}

std::vector<std::vector<ImageId>> SequencesOf(const ImageManifest& manifest) {
  std::vector<std::vector<ImageId>> sequences;
  for (auto& [drive, sequence] : SequenceOfDrives(manifest)) sequences.push_back(sequence);
  return sequences;
}

std::string PlaceOf(const LengthFault& fault, const ImageManifest& manifest) {
  const std::string& name = manifest.At(fault.image).name;
  return fault.next ? "between " + name + " and " + manifest.At(*fault.next).name : "at " + name;
}

int Percent(double share) { return static_cast<int>(std::lround(100.0 * share)); }

}  // namespace

CrossCheck CheckLengths(const JobResults& results) {
  CrossCheck check{
      .name = "step_lengths", .value = 1.0, .limit = kMinAgreeingLengths, .unit = "share"};
  const std::vector<PairLength> lengths = LengthsOf(results);
  LengthAgreement all;
  for (const PairLength& length : lengths) all.Add(length.agreement);
  check.value = all.Share();
  const std::vector<LengthFault> faults = FindLengthFaults(lengths, SequencesOf(results.manifest));
  char text[512];
  if (faults.empty()) {
    std::snprintf(text,
                  sizeof text,
                  "%d %% of the rays that tell how long steps are agree with the model, and enough "
                  "everywhere",
                  Percent(all.Share()));
    check.sentence = all.told > 0.0 ? text : "no rays tell how long steps are";
    return check;
  }
  const LengthFault& worst = *std::ranges::min_element(
      faults, {}, [](const LengthFault& fault) { return fault.agreement.Share(); });
  check.value = worst.agreement.Share();
  const auto images = static_cast<double>(
      std::ranges::count_if(faults, [](const LengthFault& fault) { return !fault.next; }));
  const bool is_bad =
      images > 1.0 && images > kBadShare * static_cast<double>(results.manifest.images.size());
  check.level = is_bad ? CheckLevel::kBad : CheckLevel::kDoubtful;
  std::snprintf(
      text,
      sizeof text,
      "of the rays that tell how long steps are only %d %% agree with the model %s, where "
      "%d %% do on the whole (%zu such places): part of it may stand a house too far along "
      "where houses repeat; give GNSS positions, or take panoramas closer together",
      Percent(check.value),
      PlaceOf(worst, results.manifest).c_str(),
      Percent(all.Share()),
      faults.size());
  check.sentence = text;
  return check;
}

}  // namespace orbweave
