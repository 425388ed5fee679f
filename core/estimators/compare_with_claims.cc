// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/compare_with_claims.h"

#include <algorithm>

#include "core/base/status.h"
#include "core/geometry/sim3.h"

namespace orbweave {
namespace {

size_t FarthestFrom(size_t held, std::span<const Rigid3> cams) {
  size_t farthest = held;
  for (size_t i = 0; i < cams.size(); ++i) {
    const auto distance = [&](size_t k) { return (cams[k].Centre() - cams[held].Centre()).norm(); };
    if (distance(i) > distance(farthest)) farthest = i;
  }
  return farthest;
}

/// Makes the pose of `held` and its distance to `farthest` those of the model.
Sim3 ModelFromReference(size_t held,
                        size_t farthest,
                        std::span<const Rigid3> cams_from_model,
                        std::span<const Rigid3> cams_from_reference) {
  const auto distance = [&](std::span<const Rigid3> cams) {
    return (cams[farthest].Centre() - cams[held].Centre()).norm();
  };
  Sim3 model_from_reference;
  const double length = distance(cams_from_reference);
  if (length > 0.0) model_from_reference.scale = distance(cams_from_model) / length;
  model_from_reference.rotation =
      cams_from_model[held].rotation.conjugate() * cams_from_reference[held].rotation;
  model_from_reference.translation =
      cams_from_model[held].Centre() - model_from_reference * cams_from_reference[held].Centre();
  return model_from_reference;
}

}  // namespace

std::optional<ClaimErrors> CompareWithClaims(std::span<const Rigid3> cams_from_model,
                                             std::span<const Eigen::Vector3d> sigmas,
                                             std::span<const Rigid3> cams_from_reference) {
  ORBWEAVE_CHECK(cams_from_model.size() == cams_from_reference.size());
  ORBWEAVE_CHECK(cams_from_model.size() == sigmas.size());
  ClaimErrors errors;
  const auto is_held = [](const Eigen::Vector3d& sigma) { return sigma.isZero(0.0); };
  const auto held = static_cast<size_t>(std::ranges::find_if(sigmas, is_held) - sigmas.begin());
  errors.is_relative = held < sigmas.size();
  size_t farthest = held;
  Sim3 model_from_reference;
  if (errors.is_relative) {
    farthest = FarthestFrom(held, cams_from_model);
    model_from_reference = ModelFromReference(held, farthest, cams_from_model, cams_from_reference);
  }
  for (size_t i = 0; i < sigmas.size(); ++i) {
    if (i == held || i == farthest || !(sigmas[i].minCoeff() > 0.0)) continue;
    const Eigen::Vector3d error =
        cams_from_model[i].Centre() - model_from_reference * cams_from_reference[i].Centre();
    errors.squared_over_variance += error.cwiseQuotient(sigmas[i]).cwiseAbs2();
    const double slack = kMisplacedSlack * model_from_reference.scale;
    if (error.norm() > 3.0 * sigmas[i].norm() + slack) ++errors.misplaced;
    ++errors.cameras;
  }
  if (errors.cameras == 0) return std::nullopt;
  errors.squared_over_variance /= static_cast<double>(errors.cameras);
  return errors;
}

}  // namespace orbweave
