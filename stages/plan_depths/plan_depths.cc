// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/plan_depths/plan_depths.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr double kRotationStep = 0x1p-21;  // of a quaternion's entries: 5e-7
constexpr int kLengthBits = 17;            // of a length: a hundred thousandth of it
constexpr int kSigmaBits = 8;

double RoundTo(double value, double step) { return step * std::round(value / step); }

/// To so many binary digits.
double RoundToBits(double value, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, bits)), exponent - bits);
}

/// The nearest width that halves evenly from scale to scale.
int WorkingWidth(const EquirectangularCamera& camera, int max_width_px) {
  return 16 * ((std::min(camera.width_px, max_width_px) + 8) / 16);
}

Rigid3 Rounded(const Rigid3& source_from_reference, double unit_m) {
  const Eigen::Quaterniond& R = source_from_reference.rotation;
  const double sign = R.w() < 0.0 ? -1.0 : 1.0;  // q and -q are the same rotation
  const Eigen::Vector4d q =
      sign * Eigen::Vector4d(R.w(), R.x(), R.y(), R.z()).unaryExpr([](double x) {
        return RoundTo(x, kRotationStep);
      });
  const Eigen::Vector3d t = source_from_reference.translation / unit_m;
  const double step = RoundToBits(t.norm(), 1) * std::ldexp(1.0, -kLengthBits);
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized(),
          t.unaryExpr([step](double x) { return RoundTo(x, step); })};
}

DepthSeed Rounded(const DepthSeed& seed, double unit_m) {
  return {.bearing = seed.bearing.unaryExpr([](double x) { return RoundTo(x, kRotationStep); }),
          .range_m = RoundToBits(seed.range_m / unit_m, kLengthBits),
          .sigma_m = RoundToBits(seed.sigma_m / unit_m, kSigmaBits)};
}

}  // namespace

DepthPlanner::DepthPlanner(const ImageManifest& manifest,
                           const FinalisedModel& model,
                           int max_width_px)
    : manifest_(manifest), max_width_px_(max_width_px) {
  plan_.mask_ignores_white = manifest.mask_ignores_white;
  for (const ImageRecord& image : manifest.images) reasons_[image.id] = "it is in no model";
  for (size_t world = 0; world < model.worlds.size(); ++world) {
    const bool is_in_frame =
        world == 0 || (model.worlds[0].report.gnss.used && model.worlds[world].report.gnss.used);
    for (const auto& [id, image] : ModelImages(model.worlds[world])) {
      if (id.value >= manifest.images.size()) continue;  // Plan refuses what names it
      if (image.loose) {
        reasons_[id] = "only a GNSS position places it, no observations";
      } else if (!is_in_frame) {
        reasons_[id] =
            "it is in a model with a frame of its own (sparse/" + std::to_string(world) + ")";
      } else {
        reasons_[id] = "no subproblem of the model has it";
        poses_[id] = image.cam_from_world;
      }
    }
  }
}

PanoramaFile DepthPlanner::FileOf(ImageId image) const {
  const ImageRecord& record = manifest_.At(image);
  return {.image = image, .camera = record.camera, .content = record.content, .mask = record.mask};
}

DepthRecipe DepthPlanner::RecipeOf(const SourceChoice& choice, double unit_m) const {
  const Rigid3 model_from_reference = poses_.at(choice.image).Inverse();
  DepthRecipe recipe{.reference = FileOf(choice.image),
                     .min_range = RoundToBits(choice.min_range_m / unit_m, kSigmaBits),
                     .max_range = RoundToBits(choice.max_range_m / unit_m, kSigmaBits),
                     .mask_ignores_white = manifest_.mask_ignores_white,
                     .width_px = WorkingWidth(manifest_.At(choice.image).camera, max_width_px_)};
  for (const ImageId source : choice.sources) {
    recipe.sources.push_back(
        {.panorama = FileOf(source),
         .source_from_reference = Rounded(poses_.at(source) * model_from_reference, unit_m)});
  }
  for (const DepthSeed& seed : choice.seeds) recipe.seeds.push_back(Rounded(seed, unit_m));
  return recipe;
}

absl::StatusOr<std::vector<DepthRecipe>> DepthPlanner::Plan(const ChosenSources& chosen) {
  std::vector<DepthRecipe> recipes;
  for (SourceChoice choice : chosen.choices) {
    if (choice.image.value >= manifest_.images.size())
      return absl::InvalidArgumentError("plan_depths: an image that the manifest does not have");
    if (!poses_.contains(choice.image)) continue;  // it has its reason
    std::erase_if(choice.sources, [this](ImageId source) { return !poses_.contains(source); });
    std::string& reason = reasons_[choice.image];
    reason = choice.problem.empty() ? "no other panorama of the model sees what it sees"
                                    : choice.problem;
    if (manifest_.At(choice.image).content.IsZero()) reason = "the job has no pictures";
    if (choice.sources.empty() || manifest_.At(choice.image).content.IsZero()) continue;
    const Eigen::Vector3d centre = poses_.at(choice.image).Centre();
    const double unit_m = (poses_.at(choice.sources.front()).Centre() - centre).norm();
    recipes.push_back(RecipeOf(choice, unit_m));
    plan_.panoramas.push_back({.file = recipes.back().reference,
                               .cam_from_model = poses_.at(choice.image),
                               .unit_m = unit_m,
                               .sources = choice.sources});
    reasons_.erase(choice.image);
  }
  return recipes;
}

DensePlan DepthPlanner::Finish() && {
  for (auto& [image, reason] : reasons_) plan_.omitted.push_back({image, std::move(reason)});
  return std::move(plan_);
}

}  // namespace orbweave
