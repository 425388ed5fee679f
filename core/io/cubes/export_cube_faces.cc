// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/cubes/export_cube_faces.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/parallel_for.h"
#include "core/base/status.h"
#include "core/io/cubes/cube_face_image.h"
#include "core/io/cubes/write_cube_transforms.h"

namespace orbweave {
namespace {

absl::Status WriteBelow(const std::string& folder,
                        const std::string& name,
                        std::string_view bytes) {
  const std::string path = absl::StrCat(folder, "/", name);
  ORBWEAVE_RETURN_IF_ERROR(
      EnsureWritableFolder(std::filesystem::path(path).parent_path().string()));
  return WriteFileAtomically(path, bytes);
}

bool AllHaveMasks(const std::map<ImageId, RegisteredImage>& images, const ImageManifest& manifest) {
  return !images.empty() && std::ranges::all_of(images, [&](const auto& image) {
    return !manifest.At(image.first).mask.IsZero();
  });
}

}  // namespace

CubeExport::CubeExport(std::string folder,
                       const std::map<ImageId, RegisteredImage>& images,
                       const ImageManifest& manifest,
                       const CubeExportOptions& options)
    : folder_(std::move(folder)), manifest_(manifest), options_(options), images_(images) {
  std::erase_if(images_, [](const auto& image) { return image.second.loose; });
  layout_ = {options.size_px, AllHaveMasks(images_, manifest)};
}

absl::Status CubeExport::Begin() {
  ORBWEAVE_RETURN_IF_ERROR(CheckCubeNames(images_, manifest_));
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(folder_));
  if (options_.colmap) {
    const std::string sparse = folder_ + "/sparse/0";
    ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(sparse));
    colmap_ = std::make_unique<CubeColmapWriter>(sparse, images_, manifest_, layout_);
  }
  if (options_.openmvs) {
    mvs_ = std::make_unique<CubeMvsWriter>(folder_ + "/scene.mvs", images_, manifest_, layout_);
  }
  return absl::OkStatus();
}

void CubeExport::AddPoint(const Track& track) {
  if (colmap_) colmap_->AddPoint(track);
  if (mvs_) mvs_->AddPoint(track);
}

absl::StatusOr<bool> CubeExport::WriteImages(const ImageRecord& record,
                                             const EncodedFileOf& panorama_of,
                                             const EncodedFileOf& mask_of) const {
  const PinholeFace pinhole = layout_.FaceOf(record.camera);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string panorama, panorama_of(record));
  if (!panorama.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const auto faces, EncodeCubeFaces(panorama, record.camera, pinhole));
    for (int face = 0; face < kCubeFaces; ++face) {
      ORBWEAVE_RETURN_IF_ERROR(
          WriteBelow(folder_, CubeImagePath(record, face), faces[static_cast<size_t>(face)]));
    }
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string mask, mask_of(record));
  if (!mask.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const auto faces,
                              EncodeCubeMasks(mask, manifest_.mask_ignores_white, pinhole));
    for (int face = 0; face < kCubeFaces; ++face) {
      ORBWEAVE_RETURN_IF_ERROR(
          WriteBelow(folder_, CubeMaskPath(record, face), faces[static_cast<size_t>(face)]));
    }
  }
  return !panorama.empty();
}

absl::StatusOr<CubeExportCounts> CubeExport::Finish(const EncodedFileOf& panorama_of,
                                                    const EncodedFileOf& mask_of) {
  if (colmap_) ORBWEAVE_RETURN_IF_ERROR(colmap_->Finish());
  if (mvs_) ORBWEAVE_RETURN_IF_ERROR(mvs_->Finish());
  if (options_.nerfstudio) {
    ORBWEAVE_RETURN_IF_ERROR(
        WriteCubeTransforms(folder_ + "/transforms.json", images_, manifest_, layout_));
  }
  std::vector<ImageId> ids;
  for (const auto& [id, image] : images_) ids.push_back(id);
  std::vector<absl::StatusOr<bool>> written(ids.size(), false);
  ParallelFor(ids.size(), options_.num_threads, [&](size_t i) {
    written[i] = WriteImages(manifest_.At(ids[i]), panorama_of, mask_of);
  });
  CubeExportCounts counts;
  for (size_t i = 0; i < ids.size(); ++i) {
    if (!written[i].ok()) return Annotate(written[i].status(), manifest_.At(ids[i]).name);
    ++counts.panoramas;
    counts.without_pixels += *written[i] ? 0 : 1;
  }
  return counts;
}

absl::StatusOr<CubeExportCounts> ExportCubeFaces(const std::string& folder,
                                                 const Reconstruction& reconstruction,
                                                 const ImageManifest& manifest,
                                                 const CubeExportOptions& options,
                                                 const EncodedFileOf& panorama_of,
                                                 const EncodedFileOf& mask_of) {
  CubeExport out(folder, reconstruction.images, manifest, options);
  ORBWEAVE_RETURN_IF_ERROR(out.Begin());
  for (const Track& track : reconstruction.tracks) out.AddPoint(track);
  return out.Finish(panorama_of, mask_of);
}

}  // namespace orbweave
