// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>

#include "core/bundle/bundle_problem.h"
#include "core/mapping/model/correspondence_graph.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// How level the cameras of a cluster are held, as their pairs have it: standard deviation, about
/// either horizontal axis, of how a camera leans. Vertical axes of two cameras that are held by the
/// same carriers lie alike, however these turn: of independent leans s the angle between them is
/// s sqrt(2) 1.18 in the median. A degree at least. nullopt where the median is more than three
/// degrees, as of panoramas held by hand, or there are fewer than ten pairs.
[[nodiscard]] std::optional<double> LevelSigma(const ClusterProblem& problem,
                                               const CorrespondenceGraph& graph);

/// An empty state whose adjustments are to hold cameras level, as level as their pairs have them;
/// with options that follow the paper to the letter an empty state.
[[nodiscard]] MappingState LevelState(const ClusterProblem& problem,
                                      const CorrespondenceGraph& graph,
                                      const MappingOptions& options);

/// Which way is up in a model, and in the cameras of each drive: R_i u_world = u_drive but for what
/// single cameras lean, in the mean over registered images; as if three cameras more of each drive
/// stood upright.
struct LevelFrame {
  Eigen::Vector3d up_in_world = Eigen::Vector3d::UnitZ();
  std::map<uint32_t, Eigen::Vector3d> up_in_cam{};  ///< of drives with registered images
};

/// nullopt: cameras do not agree which way up is (UprightFromWorld).
[[nodiscard]] std::optional<LevelFrame> FindLevelFrame(const MappingState& state);

/// Holds images level, give or take state.LevelSigma() and the slopes of streets: the pitch of a
/// pair whose facades have neither ground nor roof is good to a degree or two, and what each has
/// wrong adds up along a street. Hills are not to be flattened: a slope of five in a hundred is
/// nothing out of the way, ten panoramas in a row climb alike, and what leans by more counts for
/// less (Cauchy, three sigmas). Held to a degree or two each, streets that climbed by 15 in a
/// hundred came out flatter by a twentieth; not held at all, panoramas with few matches went
/// astray. `images`: registered, poses of the problem from the first on. Nothing where the state
/// has no sigma.
void AddLevelPriors(const MappingState& state,
                    std::span<const ImageSlot> images,
                    BundleProblem& problem);

}  // namespace orbweave
