// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/growth/grow_submodel.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/adjustment/adjust_local.h"
#include "core/mapping/adjustment/adjust_new_images.h"
#include "core/mapping/mending/carry_on_by_gnss.h"
#include "core/mapping/mending/close_drift.h"
#include "core/mapping/mending/mend_lengths.h"
#include "core/mapping/mending/reconsider_images.h"
#include "core/mapping/mending/slide_onto_gnss.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/model/rank_next_images.h"

namespace orbweave {
namespace {

constexpr int kMaxAttempts = 6;
constexpr int kFewestInliers = 8;
constexpr int kMaxMends = 3;
/// An image that failed is tried again when it sees this many times the points.
constexpr double kRetryGrowth = 1.25;

/// How hard images are tried; each step is taken when the one before registers nothing more.
enum class Effort { kNormal, kAfterGlobal, kRelaxed };

class Growth {
 public:
  Growth(MappingState& state,
         std::span<const uint8_t> available,
         const MappingOptions& options,
         RegistrationLog& log,
         const StageContext& context)
      : state_(state), available_(available), options_(options), log_(log), context_(context) {}

  absl::StatusOr<GrowthReport> Run() {
    ORBWEAVE_RETURN_IF_ERROR(AdjustEverything());
    while (true) {
      ORBWEAVE_ASSIGN_OR_RETURN(const bool registered, RegisterNext());
      if (registered) {
        effort_ = Effort::kNormal;
        if (HasGrown()) ORBWEAVE_RETURN_IF_ERROR(AdjustEverything());
        continue;
      }
      ORBWEAVE_ASSIGN_OR_RETURN(const bool goes_on, TryHarder());
      if (!goes_on) break;
    }
    // Now that all is there, whatever was tried when it was not.
    for (RegistrationRecord& record : log_) record.num_reconsidered = 0;
    ORBWEAVE_RETURN_IF_ERROR(Reconsider());
    ORBWEAVE_RETURN_IF_ERROR(Mend());
    ORBWEAVE_RETURN_IF_ERROR(Close());
    ORBWEAVE_RETURN_IF_ERROR(AdjustFinalModel(state_, options_, context_));
    ++report_.num_global_adjustments;
    DropWeakImages();
    return report_;
  }

 private:
  RegistrationLimits Limits() const {
    RegistrationLimits limits = {.max_error_px = options_.max_error_px,
                                 .min_inliers = options_.min_inliers,
                                 .heeds_pairs = schedule_.relaxes_registration};
    if (effort_ == Effort::kRelaxed) {
      limits.min_inliers =
          std::min(options_.min_inliers, std::max(kFewestInliers, options_.min_inliers / 2));
      limits.propose_from_pairs = true;
      limits.waits_for_gnss = false;  // its position may be wrong
    }
    return limits;
  }

  /// Points each image must see to be tried now.
  std::vector<uint32_t> MinVisible() const {
    const uint32_t base = effort_ == Effort::kRelaxed
                              ? 0U  // pairs may hold an image that sees no point
                              : static_cast<uint32_t>(schedule_.min_visible);
    std::vector<uint32_t> min_visible(log_.size(), base);
    for (ImageSlot image = 0; image < log_.size(); ++image) {
      const RegistrationRecord& record = log_[image];
      if (available_[image] == 0 || record.num_attempts >= kMaxAttempts) {
        min_visible[image] = std::numeric_limits<uint32_t>::max();
      } else if (record.visible_at_failure > 0) {
        min_visible[image] =
            std::max(base, static_cast<uint32_t>(kRetryGrowth * record.visible_at_failure) + 1);
      }
    }
    return min_visible;
  }

  absl::StatusOr<bool> RegisterNext() {
    for (const ImageSlot image : RankNextImages(state_, MinVisible(), schedule_.ranks_by_score)) {
      ORBWEAVE_RETURN_IF_ERROR(context_.CheckStop());
      ORBWEAVE_ASSIGN_OR_RETURN(const RegistrationAttempt attempt,
                                RegisterImage(state_, image, Limits(), context_));
      Note(image, attempt);
      if (!attempt.registered) continue;
      if (schedule_.new_images_before_local > 0)
        ORBWEAVE_RETURN_IF_ERROR(AdjustPose(state_, image, options_, context_));
      TriangulateImage(state_, image, LimitsOf(options_));
      ORBWEAVE_RETURN_IF_ERROR(AdjustAround(image));
      context_.Report(state_.Registered().size(), state_.Graph().NumImages(), "images");
      return true;
    }
    return false;
  }

  /// The local adjustment after `image` was registered, where the schedule has one now.
  absl::Status AdjustAround(ImageSlot image) {
    if (schedule_.new_images_before_local == 0) {
      ++report_.num_local_adjustments;
      return AdjustLocally(state_, image, options_, context_);
    }
    new_images_.push_back(image);
    if (new_images_.size() <= static_cast<size_t>(schedule_.new_images_before_local))
      return absl::OkStatus();
    ++report_.num_local_adjustments;
    const std::vector<ImageSlot> images = std::exchange(new_images_, {});
    return AdjustNewImages(state_, images, options_, context_);
  }

  void Note(ImageSlot image, const RegistrationAttempt& attempt) {
    RegistrationRecord& record = log_[image];
    record.num_attempts += attempt.waits ? 0 : 1;
    record.contradicted = attempt.waits && !attempt.registered;
    record.obstacle = attempt.registered ? RegistrationObstacle::kNone : attempt.obstacle;
    record.visible_at_failure = attempt.registered ? 0 : attempt.num_visible;
    record.best_visible = std::max(record.best_visible, attempt.num_visible);
    if (attempt.registered) record.loss = RegistrationLoss::kNone;
    const bool sees_enough = attempt.num_visible >= static_cast<uint32_t>(Limits().min_inliers);
    if (!sees_enough || attempt.num_inliers < record.best_inliers) return;
    record.best_inliers = attempt.num_inliers;
    record.needed_inliers = NeededInliers(Limits(), attempt.num_visible);
  }

  /// Few new images are in the hands of local adjustments, whose windows overlap.
  bool HasGrown() const {
    const auto images = static_cast<double>(state_.Registered().size());
    const bool is_local = schedule_.new_images_before_local == 0;
    if (is_local && images < images_adjusted_ + options_.local_window / 3) return false;
    const double factor = 1.0 + options_.global_growth;
    return images >= factor * images_adjusted_ ||
           static_cast<double>(state_.NumPoints()) >= factor * points_adjusted_;
  }

  absl::Status AdjustEverything() {
    ORBWEAVE_RETURN_IF_ERROR(AdjustGrowingModel(state_, options_, context_));
    ++report_.num_global_adjustments;
    DropWeakImages();
    ORBWEAVE_RETURN_IF_ERROR(Reconsider());
    new_images_.clear();
    images_adjusted_ = static_cast<double>(state_.Registered().size());
    points_adjusted_ = static_cast<double>(state_.NumPoints());
    return absl::OkStatus();
  }

  absl::Status Reconsider() {
    if (!schedule_.relaxes_registration) return absl::OkStatus();
    return ReconsiderImages(state_, options_, Limits(), log_, context_);
  }

  absl::Status Mend() {
    if (!schedule_.relaxes_registration) return absl::OkStatus();
    for (int i = 0; i < kMaxMends; ++i) {
      ORBWEAVE_ASSIGN_OR_RETURN(const bool is_mended, MendLengths(state_, options_, context_));
      if (!is_mended) break;
      ++report_.num_global_adjustments;
    }
    ORBWEAVE_ASSIGN_OR_RETURN(const bool has_slid, SlideOntoGnss(state_, options_, context_));
    report_.num_global_adjustments += has_slid ? 1 : 0;
    ORBWEAVE_ASSIGN_OR_RETURN(const bool is_carried_on, CarryOnByGnss(state_, options_, context_));
    report_.num_global_adjustments += is_carried_on ? 1 : 0;
    return absl::OkStatus();
  }

  absl::Status Close() {
    if (!schedule_.relaxes_registration) return absl::OkStatus();
    ORBWEAVE_ASSIGN_OR_RETURN(const bool is_closed, CloseDrift(state_, options_, context_));
    report_.num_global_adjustments += is_closed ? 1 : 0;
    return absl::OkStatus();
  }

  /// Images that kept hardly a point were registered wrongly; they may be tried again.
  void DropWeakImages() {
    const auto fewest = static_cast<uint32_t>(std::min(options_.min_inliers, kFewestInliers));
    const std::vector<ImageSlot> registered = state_.Registered();
    for (const ImageSlot image : registered) {
      if (state_.NumObservations(image) >= fewest) continue;
      log_[image].loss = RegistrationLoss::kPoints;
      state_.Deregister(image);
    }
  }

  /// False when everything has been tried.
  absl::StatusOr<bool> TryHarder() {
    NoteVisible();
    if (state_.Registered().size() == state_.Graph().NumImages()) return false;
    if (effort_ == Effort::kRelaxed) return false;
    if (effort_ == Effort::kNormal) {
      effort_ = Effort::kAfterGlobal;
      if (static_cast<double>(state_.Registered().size()) > images_adjusted_) {
        ORBWEAVE_RETURN_IF_ERROR(AdjustEverything());
      }
    } else {
      if (!schedule_.relaxes_registration) return false;
      effort_ = Effort::kRelaxed;
    }
    for (RegistrationRecord& record : log_) record.visible_at_failure = 0;
    return true;
  }

  void NoteVisible() {
    for (ImageSlot image = 0; image < log_.size(); ++image) {
      log_[image].best_visible = std::max(log_[image].best_visible, state_.Visible(image).Count());
    }
  }

  MappingState& state_;
  std::span<const uint8_t> available_;
  const MappingOptions& options_;
  RegistrationLog& log_;
  const StageContext& context_;
  const MappingSchedule schedule_ = ScheduleOf(options_);
  std::vector<ImageSlot> new_images_{};  ///< since the last adjustment, where the schedule counts
  Effort effort_ = Effort::kNormal;
  GrowthReport report_{};
  double images_adjusted_ = 0.0;
  double points_adjusted_ = 0.0;
};

}  // namespace

absl::StatusOr<GrowthReport> GrowSubmodel(MappingState& state,
                                          std::span<const uint8_t> available,
                                          const MappingOptions& options,
                                          RegistrationLog& log,
                                          const StageContext& context) {
  return Growth(state, available, options, log, context).Run();
}

}  // namespace orbweave
