// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/borne_out_by_gnss.h"

#include <algorithm>

#include "core/base/quantile.h"
#include "core/graph/positions_by_motion.h"
#include "core/scene/sequence_of_drive.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr size_t kAround = 5;
constexpr size_t kFewest = 3;
constexpr double kAgreeing = 0.75;
constexpr double kSigmas = 3.0;

/// Of the positions of a stretch.
struct Tally {
  size_t positions = 0;
  size_t agreeing = 0;

  [[nodiscard]] bool BearsOut() const {
    return positions >= kFewest &&
           static_cast<double>(agreeing) >= kAgreeing * static_cast<double>(positions);
  }
};

}  // namespace

BorneOutByGnss::BorneOutByGnss(const JobResults& results)
    : places_(results.manifest.images.size()) {
  for (size_t model = results.models.size(); model-- > 0;) {
    if (!results.models[model].report.gnss.used) continue;
    for (const auto& [id, image] : results.models[model].images) {
      if (image.loose || id.value >= places_.size()) continue;
      places_[id.value] = Place{model, image.cam_from_world.Centre().head<2>()};
    }
  }
  const std::vector<PositionByMotion> by_motion = PositionsByMotion(results.manifest);
  for (const auto& [drive, sequence] : SequenceOfDrives(results.manifest))
    TakeDrive(results.manifest, by_motion, sequence);
}

void BorneOutByGnss::TakeDrive(const ImageManifest& manifest,
                               const std::vector<PositionByMotion>& by_motion,
                               const std::vector<ImageId>& sequence) {
  std::vector<const PosePrior*> priors;
  for (const ImageId image : sequence) priors.push_back(&manifest.At(image).prior);
  const double usual_step_m = UsualStep(priors);
  std::vector<std::optional<Place>> borne_out(sequence.size());
  for (size_t i = 0; i < sequence.size(); ++i) {
    const std::optional<Place>& here = places_[sequence[i].value];
    if (!here) continue;
    Tally tally;
    std::vector<double> sigmas_m;
    const size_t end = std::min(sequence.size(), i + kAround + 1);
    for (size_t k = i - std::min(i, kAround); k < end; ++k) {
      const std::optional<Place>& there = places_[sequence[k].value];
      if (!there || there->model != here->model || !priors[k]->position_in_enu) continue;
      const PosePrior& prior = by_motion[sequence[k].value].prior;
      const double error_m = (prior.position_in_enu->head<2>() - there->in_enu).norm();
      ++tally.positions;
      tally.agreeing += error_m <= kSigmas * prior.horizontal_sigma_m ? 1 : 0;
      sigmas_m.push_back(prior.horizontal_sigma_m);
    }
    if (!tally.BearsOut()) continue;
    borne_out[i] = here;
    borne_out[i]->reach_m = kSeenWithin_steps * usual_step_m + kSigmas * Quantile(sigmas_m, 0.5);
  }
  for (size_t i = 0; i < sequence.size(); ++i) places_[sequence[i].value] = borne_out[i];
}

bool BorneOutByGnss::AreApart(const ImagePair& pair) const {
  const std::optional<Place>& a = places_[pair.a.value];
  const std::optional<Place>& b = places_[pair.b.value];
  return a && b && a->model == b->model &&
         (a->in_enu - b->in_enu).norm() > std::max(a->reach_m, b->reach_m);
}

}  // namespace orbweave
