// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/offer_files.h"

#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/io/file.h"

namespace orbweave {
namespace {

absl::Status OfferFile(BlobDepot& depot, const Digest& digest, const std::string& path) {
  const absl::Status linked = depot.LinkFile(digest, path);
  if (linked.ok() || absl::IsDataLoss(linked)) return linked;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest stored, depot.Put(bytes));
  if (stored != digest) return absl::DataLossError(path + " changed while it was read; run again");
  return absl::OkStatus();
}

}  // namespace

absl::Status OfferFiles(BlobDepot& depot,
                        const ImageSources& sources,
                        const StageContext& context) {
  std::vector<Digest> digests;
  std::vector<std::string> paths;
  for (const SourceImage& image : sources.images) {
    if (!image.problem.empty()) continue;
    digests.push_back(image.content);
    paths.push_back(image.path);
    if (image.mask.IsZero()) continue;
    digests.push_back(image.mask);
    paths.push_back(image.mask_path);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<bool> known, depot.StatBlobs(digests));
  for (size_t i = 0; i < digests.size(); ++i) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    if (!known[i]) ORBWEAVE_RETURN_IF_ERROR(OfferFile(depot, digests[i], paths[i]));
    context.Report(i + 1, digests.size(), "files");
  }
  return absl::OkStatus();
}

}  // namespace orbweave
