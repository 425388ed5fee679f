// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/write_models.h"

#include <map>
#include <string>
#include <utility>

#include "core/base/status.h"

namespace orbweave {

namespace fs = std::filesystem;

ModelWriter::ModelWriter(BlobAccess& coordinator,
                         std::vector<Digest> feature_names,
                         fs::path folder)
    : coordinator_(coordinator),
      feature_names_(std::move(feature_names)),
      folder_(std::move(folder)) {}

void ModelWriter::BeginModel(const std::map<ImageId, RegisteredImage>& images,
                             const ImageManifest& manifest) {
  const std::string sparse = (folder_ / "sparse" / std::to_string(num_models_)).string();
  status_.Update(EnsureWritableFolder(sparse));
  images_ = images;
  std::erase_if(images_, [](const auto& image) { return image.second.loose; });
  colmap_ = std::make_unique<ColmapModelWriter>(sparse, images_, manifest);
  if (num_models_ == 0) points_ = std::make_unique<PlyWriter>((folder_ / "points.ply").string());
  ++num_models_;
}

void ModelWriter::TakePoint(const Track& track) {
  colmap_->AddPoint(track);
  if (points_) points_->Add(track);
}

absl::Status ModelWriter::AddImages() {
  for (const auto& [id, image] : images_) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Features features,
                              FetchFeatures(coordinator_, feature_names_.at(id.value)));
    colmap_->AddImage(id, features.keypoints);
  }
  return colmap_->Finish();
}

absl::Status ModelWriter::EndModel() {
  ORBWEAVE_RETURN_IF_ERROR(status_);
  ORBWEAVE_RETURN_IF_ERROR(AddImages());
  colmap_.reset();
  if (points_) ORBWEAVE_RETURN_IF_ERROR(points_->Finish());
  points_.reset();
  return absl::OkStatus();
}

absl::Status ModelWriter::Finish() {
  for (size_t stale = num_models_;; ++stale) {
    std::error_code error;
    if (fs::remove_all(folder_ / "sparse" / std::to_string(stale), error) == 0 || error) break;
  }
  if (num_models_ > 0) return absl::OkStatus();
  return PlyWriter((folder_ / "points.ply").string()).Finish();
}

}  // namespace orbweave
