// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/rotation.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// How far a model is from the truth once rotations and centres are brought together by one
/// similarity: its rotation from the mean of the images' rotations (the centres of a straight walk
/// leave the roll about the street open), scale and translation from the centres.
struct ModelError {
  double position_rmse = 0.0;  ///< units of the truth
  double max_rotation_rad = 0.0;
};

/// `truth`: cam_from_world per image id.
inline ModelError ErrorOf(const Reconstruction& model, const std::vector<Rigid3>& truth) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();  // of truth_from_model rotations
  Eigen::Vector3d mean_model = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_truth = Eigen::Vector3d::Zero();
  const auto count = static_cast<double>(model.images.size());
  for (const auto& [id, image] : model.images) {
    sum +=
        (truth[id.value].rotation.conjugate() * image.cam_from_world.rotation).toRotationMatrix();
    mean_model += image.cam_from_world.Centre() / count;
    mean_truth += truth[id.value].Centre() / count;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Quaterniond R(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()));
  double model_dot_truth = 0.0;
  double model_dot_model = 0.0;
  for (const auto& [id, image] : model.images) {
    const Eigen::Vector3d x = R * (image.cam_from_world.Centre() - mean_model);
    model_dot_truth += x.dot(truth[id.value].Centre() - mean_truth);
    model_dot_model += x.squaredNorm();
  }
  const double scale = model_dot_truth / model_dot_model;
  ModelError error;
  double sum2 = 0.0;
  for (const auto& [id, image] : model.images) {
    const Eigen::Vector3d x = scale * (R * (image.cam_from_world.Centre() - mean_model));
    sum2 += (x - (truth[id.value].Centre() - mean_truth)).squaredNorm();
    const Eigen::Quaterniond difference =
        image.cam_from_world.rotation * (truth[id.value].rotation * R).conjugate();
    error.max_rotation_rad = std::max(error.max_rotation_rad, RotationAngle(difference));
  }
  error.position_rmse = std::sqrt(sum2 / count);
  return error;
}

}  // namespace orbweave
