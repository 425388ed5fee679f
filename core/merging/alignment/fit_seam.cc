// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/fit_seam.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/quantile.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

constexpr size_t kMaxVotingTracks = 150;
constexpr size_t kMaxProposingCameras = 40;
constexpr size_t kMaxPartners = 8;
constexpr int kRefinements = 5;

// About `count` of n positions, evenly spread.
std::vector<size_t> Spread(size_t n, size_t count) {
  std::vector<size_t> chosen;
  const size_t taken = std::min(n, count);
  for (size_t i = 0; i < taken; ++i) chosen.push_back(i * n / taken);
  return chosen;
}

// Scale s that makes distances from a camera in b those in a: from points, then from other centres.
std::vector<double> ProposeScales(const SeamEvidence& evidence,
                                  const std::vector<size_t>& voters,
                                  size_t camera) {
  const Eigen::Vector3d centre_in_a = evidence.cameras[camera].cam_from_a.Centre();
  const Eigen::Vector3d centre_in_b = evidence.cameras[camera].cam_from_b.Centre();
  std::vector<double> ratios;
  for (const size_t t : voters) {
    const double in_a = (evidence.tracks[t].point_in_a - centre_in_a).norm();
    const double in_b = (evidence.tracks[t].point_in_b - centre_in_b).norm();
    if (in_a > 0.0 && in_b > 0.0) ratios.push_back(in_a / in_b);
  }
  std::vector<double> scales;
  if (!ratios.empty()) scales.push_back(Quantile(std::move(ratios), 0.5));
  for (const size_t partner : Spread(evidence.cameras.size(), kMaxPartners)) {
    const SeamCamera& other = evidence.cameras[partner];
    const double in_a = (other.cam_from_a.Centre() - centre_in_a).norm();
    const double in_b = (other.cam_from_b.Centre() - centre_in_b).norm();
    if (in_a > 0.0 && in_b > 0.0) scales.push_back(in_a / in_b);
  }
  return scales;
}

// Agreement with a similarity: one vote per track and camera, falling to 0 at the error bound.
double Score(const SeamEvidence& evidence,
             const std::vector<size_t>& voters,
             const Sim3& a_from_b,
             double max_error) {
  const auto vote = [&](double error) {
    return std::max(0.0, 1.0 - error * error / (max_error * max_error));
  };
  double score = 0.0;
  for (const size_t t : voters) score += vote(TrackError(evidence.tracks[t], a_from_b));
  for (const SeamCamera& camera : evidence.cameras)
    score += vote(CameraError(camera, a_from_b) / 3.0);
  return score;
}

Sim3 BestProposal(const SeamEvidence& evidence, double max_error) {
  const std::vector<size_t> voters = Spread(evidence.tracks.size(), kMaxVotingTracks);
  Sim3 best;
  double best_score = -1.0;
  for (const size_t c : Spread(evidence.cameras.size(), kMaxProposingCameras)) {
    const SeamCamera& camera = evidence.cameras[c];
    const Eigen::Quaterniond R =
        (camera.cam_from_a.rotation.conjugate() * camera.cam_from_b.rotation).normalized();
    for (const double s : ProposeScales(evidence, voters, c)) {
      const Sim3 proposal{s, R, camera.cam_from_a.Centre() - s * (R * camera.cam_from_b.Centre())};
      const double score = Score(evidence, voters, proposal, max_error);
      if (score <= best_score) continue;
      best_score = score;
      best = proposal;
    }
  }
  return best;
}

// Anchored at the mean of the common centres, as long as the median distance of the common points.
SimilarityChart MakeChart(const SeamEvidence& evidence, const Sim3& a_from_b) {
  SimilarityChart chart{.a_from_b = a_from_b};
  std::vector<double> distances;
  for (const SeamCamera& camera : evidence.cameras) {
    chart.anchor_in_b += camera.cam_from_b.Centre() / static_cast<double>(evidence.cameras.size());
    distances.push_back(camera.depth_in_a);
  }
  const Eigen::Vector3d anchor_in_a = a_from_b * chart.anchor_in_b;
  if (!evidence.tracks.empty()) distances.clear();
  for (const SeamTrack& track : evidence.tracks) {
    distances.push_back((track.point_in_a - anchor_in_a).norm());
  }
  chart.length_in_a =
      std::max(Quantile(std::move(distances), 0.5), std::numeric_limits<double>::min());
  return chart;
}

Linearisation<7> Linearise(const SeamEvidence& evidence,
                           const SimilarityChart& chart,
                           const CauchyLoss& loss) {
  Linearisation<7> sum;
  for (const SeamTrack& track : evidence.tracks) AddTrack(track, chart, loss, sum);
  for (const SeamCamera& camera : evidence.cameras) AddCamera(camera, chart, loss, sum);
  return sum;
}

// Scale of the loss: the error that a decent quarter of the evidence stays below, doubled; at least
// the noise of a bearing.
double LossScale(const SeamEvidence& evidence, const Sim3& a_from_b) {
  std::vector<double> errors;
  for (const SeamTrack& track : evidence.tracks) errors.push_back(TrackError(track, a_from_b));
  for (const SeamCamera& camera : evidence.cameras) errors.push_back(CameraError(camera, a_from_b));
  return std::max(1.0, 2.0 * Quantile(std::move(errors), 0.25));
}

SimilarityChart Refine(const SeamEvidence& evidence, SimilarityChart chart) {
  for (int i = 0; i < kRefinements; ++i) {
    const CauchyLoss loss(LossScale(evidence, chart.a_from_b));
    chart = MinimiseLevenbergMarquardt<7>(
        chart,
        [&](const SimilarityChart& state) { return Linearise(evidence, state, loss); },
        [](SimilarityChart state, const Vector7d& x) {
          state.a_from_b = state.At(x);
          return state;
        });
  }
  return chart;
}

// Condition and covariance from the information matrix of the last linearisation.
void Certify(const SeamEvidence& evidence, SeamFit& fit) {
  const double scale = LossScale(evidence, fit.chart.a_from_b);
  const Matrix7d H =
      Linearise(evidence, fit.chart, CauchyLoss(scale)).H.selfadjointView<Eigen::Lower>();
  const Eigen::SelfAdjointEigenSolver<Matrix7d> eigen(H);
  const Vector7d& values = eigen.eigenvalues();
  const double floor = std::max(1e-14 * values[6], std::numeric_limits<double>::min());
  fit.condition_number =
      values[0] > floor ? values[6] / values[0] : std::numeric_limits<double>::infinity();
  fit.covariance = scale * scale * eigen.eigenvectors() *
                   values.cwiseMax(floor).cwiseInverse().asDiagonal() *
                   eigen.eigenvectors().transpose();
}

}  // namespace

SeamFit FitSeam(const SeamEvidence& evidence, double max_error) {
  SeamFit fit;
  fit.chart = Refine(evidence, MakeChart(evidence, BestProposal(evidence, max_error)));
  Certify(evidence, fit);
  for (const SeamTrack& track : evidence.tracks) {
    if (TrackError(track, fit.chart.a_from_b) <= max_error) ++fit.inlier_tracks;
  }
  for (const SeamCamera& camera : evidence.cameras) {
    if (CameraError(camera, fit.chart.a_from_b) <= 3.0 * max_error) ++fit.inlier_cameras;
  }
  return fit;
}

}  // namespace orbweave
