// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/offer_files.h"

#include <atomic>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "core/base/parallel_for.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

/// A file that the job reads.
struct Offer {
  FilePlace* place = nullptr;
  std::string path{};
  Digest digest{};
  bool is_known = false;  ///< the depot has it
};

/// Each content once: many images may have the same mask.
std::vector<Offer> OffersOf(const ImageSources& sources, const ImagePlaces& places) {
  std::vector<Offer> offers;
  std::set<Digest> offered = {Digest{}};
  for (const SourceImage& image : sources.images) {
    if (!image.problem.empty()) continue;
    if (offered.insert(image.content).second)
      offers.push_back({places.images.get(), image.path, image.content});
    if (offered.insert(image.mask).second)
      offers.push_back({places.masks.get(), image.mask_path, image.mask});
  }
  return offers;
}

/// Whether its bytes were sent.
absl::StatusOr<bool> SendUnlessLinked(BlobDepot& depot,
                                      const Offer& offer,
                                      const StageContext& context) {
  if (offer.is_known) return false;
  const absl::Status linked = depot.LinkFile(offer.digest, offer.path);
  if (linked.ok()) return false;
  // A root that leads nowhere is to be mended: not to be paid for by sending everything.
  if (absl::IsDataLoss(linked) || absl::IsUnavailable(linked) || absl::IsFailedPrecondition(linked))
    return linked;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, offer.place->Read(offer.path, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest stored, depot.Put(bytes));
  if (stored == offer.digest) return true;
  return absl::DataLossError(offer.path + " changed while it was read; run again");
}

}  // namespace

absl::Status OfferFiles(BlobDepot& depot,
                        const ImageSources& sources,
                        const ImagePlaces& places,
                        const StageContext& context) {
  std::vector<Offer> offers = OffersOf(sources, places);
  std::vector<Digest> digests;
  for (const Offer& offer : offers) digests.push_back(offer.digest);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<bool> known, depot.StatBlobs(digests));
  for (size_t i = 0; i < offers.size(); ++i) offers[i].is_known = known[i];
  std::vector<absl::Status> errors(offers.size());
  std::mutex mutex;
  std::atomic<bool> is_over{false};
  bool some_sent = false;
  uint64_t done = 0;
  ParallelFor(offers.size(), places.NumReaders(), [&](size_t i) {
    if (is_over || !context.CheckStop().ok()) return;
    const absl::StatusOr<bool> sent = SendUnlessLinked(depot, offers[i], context);
    errors[i] = sent.status();
    if (!sent.ok()) is_over = true;
    const std::lock_guard lock(mutex);
    some_sent = some_sent || (sent.ok() && *sent);
    context.Report(++done, offers.size(), some_sent ? "files, some sent" : "files");
  });
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  for (const absl::Status& error : errors) ORBWEAVE_RETURN_IF_ERROR(error);
  return absl::OkStatus();
}

}  // namespace orbweave
