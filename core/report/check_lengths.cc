// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_lengths.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/io/first_names.h"
#include "core/mapping/lengths/find_length_faults.h"
#include "core/report/lengths_within_models.h"
#include "core/report/model_of_images.h"

namespace orbweave {
namespace {

constexpr char kAdvice[] = "give GNSS positions, or take panoramas closer together";
constexpr double kBadShare = 0.02;  // one in fifty, as in CheckSequenceSteps
/// Right steps of streets whose houses repeat have half of the usual share or more, but for some; a
/// step that was seven hundredths off had two fifths of it.
constexpr double kWeakShare = 0.5;
constexpr size_t kFewestSteps = 8;
constexpr size_t kPlacesShown = 7;
/// So many that agree to 6 % (kCloseTolerance) tell a length to a hundredth.
constexpr double kRaysForAHundredth = 36.0;

bool AgreesLess(const PairLength& one, const PairLength& other) {
  return one.agreement.Share() < other.agreement.Share();
}

/// Whether more is wrong with it, or as little and fewer rays agree.
bool AgreesLess(const GapLength& one, const GapLength& other) {
  const auto faults = [](const GapLength& gap) { return FindLengthFaults({}, {&gap, 1}).size(); };
  if (faults(one) != faults(other)) return faults(one) > faults(other);
  return one.agreement.Share() < other.agreement.Share();
}

/// Images all of whose ways are borne out.
std::set<ImageId> BorneOutImages(const std::vector<GapLength>& gaps) {
  std::set<ImageId> borne_out;
  std::set<ImageId> others;
  for (const GapLength& gap : gaps)
    (gap.is_borne_out ? borne_out : others).insert({gap.between.a, gap.between.b});
  for (const ImageId image : others) borne_out.erase(image);
  return borne_out;
}

/// Which model each image is in, and whether GNSS holds that: its sigmas then hold what one step
/// may be off.
class ModelsHeldByGnss {
 public:
  explicit ModelsHeldByGnss(const JobResults& results)
      : results_(results), model_of_image_(ModelOfImages(results)) {}

  /// Negative: in none.
  [[nodiscard]] int ModelOf(ImageId image) const { return model_of_image_[image.value]; }
  [[nodiscard]] bool Hold(ImageId image) const {
    const int model = ModelOf(image);
    return model >= 0 && results_.models[static_cast<size_t>(model)].report.gnss.used;
  }

 private:
  const JobResults& results_;
  std::vector<int> model_of_image_;
};

/// FindLengthFaults, without images that their ways bear out, and ways that one wall alone has a
/// part of a step longer or shorter, where GNSS holds the model.
std::vector<LengthFault> FaultsThatStand(const std::vector<PairLength>& lengths,
                                         const std::vector<GapLength>& gaps,
                                         const ModelsHeldByGnss& held) {
  const std::set<ImageId> borne_out = BorneOutImages(gaps);
  std::vector<LengthFault> faults = FindLengthFaults(lengths, gaps);
  std::erase_if(faults, [&](const LengthFault& fault) {
    return (fault.kind == LengthFaultKind::kImage && borne_out.contains(fault.image)) ||
           (fault.kind == LengthFaultKind::kWall && held.Hold(fault.image));
  });
  return faults;
}

std::string PlaceOf(const LengthFault& fault, const ImageManifest& manifest) {
  const std::string& name = manifest.At(fault.image).name;
  return fault.next ? "between " + name + " and " + manifest.At(*fault.next).name : "at " + name;
}

/// The places of all but the worst: "; 2 more places are doubted: between a and b, at c"; empty
/// where there are none.
std::string OtherPlaces(std::vector<LengthFault> faults,
                        const LengthFault& worst,
                        const ImageManifest& manifest) {
  std::erase_if(faults, [&](const LengthFault& fault) {
    return fault.image == worst.image && fault.next == worst.next;
  });
  if (faults.empty()) return "";
  std::vector<std::string> places;
  for (const LengthFault& fault : faults) places.push_back(PlaceOf(fault, manifest));
  return "; " + std::to_string(places.size()) + " more " +
         (places.size() == 1 ? "place is" : "places are") +
         " doubted: " + FirstNames(places, kPlacesShown);
}

int Percent(double share) { return static_cast<int>(std::lround(100.0 * share)); }

std::string WhatRaysSay(const LengthFault& fault, const ImageManifest& manifest) {
  char text[256];
  const bool is_of_wall = fault.kind == LengthFaultKind::kWall;
  if (is_of_wall || fault.kind == LengthFaultKind::kElsewhere) {
    const double here = fault.agreement.agreeing;
    std::snprintf(
        text,
        sizeof text,
        "of the rays %sthat tell how long steps are, %.0f say another length than the model "
        "has %s, and %.0f the model's",
        is_of_wall ? "to one side of the street " : "",
        fault.agreement.told - here,
        PlaceOf(fault, manifest).c_str(),
        here);
  } else if (fault.kind == LengthFaultKind::kScale) {
    std::snprintf(text,
                  sizeof text,
                  "on one side of the way %s steps are longer and what is seen is farther away, by "
                  "%.0f times or more: a part of the street has a scale of its own",
                  PlaceOf(fault, manifest).c_str(),
                  1.0 / fault.agreement.Share());
  } else if (fault.kind == LengthFaultKind::kHinge) {
    std::snprintf(
        text,
        sizeof text,
        "of the matches of neighbouring panoramas only %d %% agree with the model %s, whose "
        "two sides stand askew to each other",
        Percent(fault.agreement.Share()),
        PlaceOf(fault, manifest).c_str());
  } else {
    std::snprintf(text,
                  sizeof text,
                  "of the rays that tell how long steps are, only %d %% agree with the model %s",
                  Percent(fault.agreement.Share()),
                  PlaceOf(fault, manifest).c_str());
  }
  return text;
}

/// A step whose length fewer rays agree with than is usual in its model.
struct WeakStep {
  GapLength gap{};
  double usual_share = 0.0;
};

/// That of the rays which agree with it; 1 of a step that is known to a hundredth all the same.
double ShareOf(const GapLength& gap) {
  const bool is_known = gap.is_borne_out && gap.here >= kRaysForAHundredth;
  return is_known ? 1.0 : gap.agreement.Share();
}

/// The weakest of one model: `gaps` that tell enough.
std::optional<WeakStep> WeakestOf(const std::vector<GapLength>& gaps) {
  if (gaps.size() < kFewestSteps) return std::nullopt;
  std::vector<double> shares;
  for (const GapLength& gap : gaps) shares.push_back(gap.agreement.Share());
  const GapLength& weakest = *std::ranges::min_element(gaps, {}, ShareOf);
  const double usual = Quantile(std::move(shares), 0.5);
  if (ShareOf(weakest) >= kWeakShare * usual) return std::nullopt;
  return WeakStep{weakest, usual};
}

/// In models that no GNSS holds.
std::optional<WeakStep> FindWeakStep(const ModelsHeldByGnss& held,
                                     const std::vector<GapLength>& gaps) {
  std::map<int, std::vector<GapLength>> of_model;
  for (const GapLength& gap : gaps) {
    const int model = held.ModelOf(gap.between.a);
    if (model < 0 || held.Hold(gap.between.a)) continue;
    if (TellsEnough(gap.agreement, gap.pairs)) of_model[model].push_back(gap);
  }
  for (const auto& [model, steps] : of_model) {
    if (std::optional<WeakStep> weak = WeakestOf(steps)) return weak;
  }
  return std::nullopt;
}

void DoubtWeakStep(const WeakStep& weak, const ImageManifest& manifest, CrossCheck& check) {
  check.value = weak.gap.agreement.Share();
  check.limit = kWeakShare * weak.usual_share;
  check.level = CheckLevel::kDoubtful;
  char text[512];
  std::snprintf(text,
                sizeof text,
                "of the rays that tell how long steps are, only %d %% agree with the model between "
                "%s and %s, where %d %% are usual in it, and no GNSS tells its length: it may be "
                "off by some hundredths; ",
                Percent(check.value),
                manifest.At(weak.gap.between.a).name.c_str(),
                manifest.At(weak.gap.between.b).name.c_str(),
                Percent(weak.usual_share));
  check.sentence = std::string(text) + kAdvice;
}

}  // namespace

CrossCheck CheckLengths(const JobResults& results) {
  CrossCheck check{
      .name = "step_lengths", .value = 1.0, .unit = "share", .bound = CheckBound::kAtLeast};
  const auto agrees_less = [](const auto& one, const auto& other) {
    return AgreesLess(one, other);
  };
  const std::vector<PairLength> lengths =
      LengthsWithinModels(results, &ClusterSummary::pair_lengths, &PairLength::pair, agrees_less);
  const std::vector<GapLength> gaps =
      LengthsWithinModels(results, &ClusterSummary::gap_lengths, &GapLength::between, agrees_less);
  const ModelsHeldByGnss held(results);
  LengthAgreement all;
  for (const PairLength& length : lengths) all.Add(length.agreement);
  check.value = all.Share();
  const std::vector<LengthFault> faults = FaultsThatStand(lengths, gaps, held);
  char text[512];
  if (faults.empty()) {
    std::snprintf(text,
                  sizeof text,
                  "%d %% of the rays that tell how long steps are agree with the model, and enough "
                  "everywhere",
                  Percent(all.Share()));
    check.sentence = all.told > 0.0 ? text : "no rays tell how long steps are";
    if (const std::optional<WeakStep> weak = FindWeakStep(held, gaps))
      DoubtWeakStep(*weak, results.manifest, check);
    return check;
  }
  const LengthFault& worst = *std::ranges::min_element(
      faults, {}, [](const LengthFault& fault) { return fault.agreement.Share(); });
  check.value = worst.agreement.Share();
  check.limit = worst.MinShare();
  const auto images = static_cast<double>(
      std::ranges::count_if(faults, [](const LengthFault& fault) { return !fault.next; }));
  const bool is_bad =
      images > 1.0 && images > kBadShare * static_cast<double>(results.manifest.images.size());
  check.level = is_bad ? CheckLevel::kBad : CheckLevel::kDoubtful;
  std::snprintf(text,
                sizeof text,
                "%d %% of the rays agree on the whole: part of it may stand a house too far along "
                "where houses repeat; ",
                Percent(all.Share()));
  check.sentence = WhatRaysSay(worst, results.manifest) +
                   OtherPlaces(faults, worst, results.manifest) + "; " + text + kAdvice;
  return check;
}

}  // namespace orbweave
