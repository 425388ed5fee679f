// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/cubes/cube_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "core/io/text_fields.h"

namespace orbweave {

PinholeFace CubeLayout::FaceOf(const EquirectangularCamera& camera) const {
  if (size_px > 0) return {size_px};
  return {std::max(1, static_cast<int>(std::lround(camera.width_px / std::numbers::pi)))};
}

std::string_view CubeFaceName(int face) {
  constexpr std::array<std::string_view, kCubeFaces> kNames = {
      "front", "right", "back", "left", "up", "down"};
  return kNames.at(static_cast<size_t>(face));
}

std::string CubeImageName(const ImageRecord& record, int face) {
  const std::string extension = LowerText(std::filesystem::path(record.name).extension().string());
  const bool jpeg = extension == ".jpg" || extension == ".jpeg";
  return absl::StrCat(std::string(CubeFaceName(face)), "/", record.name, jpeg ? "" : ".jpg");
}

std::string CubeImagePath(const ImageRecord& record, int face) {
  return absl::StrCat("images/", CubeImageName(record, face));
}

std::string CubeMaskPath(const ImageRecord& record, int face) {
  return absl::StrCat("masks/", CubeImageName(record, face), ".png");
}

absl::Status CheckCubeNames(const std::map<ImageId, RegisteredImage>& images,
                            const ImageManifest& manifest) {
  for (const auto& [id, image] : images) {
    const std::string& name = manifest.At(id).name;
    const std::filesystem::path path(name);
    const bool leaves = std::ranges::find(path, std::filesystem::path("..")) != path.end();
    if (!name.empty() && !path.is_absolute() && !leaves) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        "image '", name, "' cannot be exported: its name leads out of the folder; rename it"));
  }
  return absl::OkStatus();
}

std::vector<PinholeFace> CubeRigs(const std::map<ImageId, RegisteredImage>& images,
                                  const ImageManifest& manifest,
                                  const CubeLayout& layout) {
  std::vector<PinholeFace> rigs;
  for (const auto& [id, image] : images) {
    const PinholeFace pinhole = layout.FaceOf(manifest.At(id).camera);
    if (std::ranges::find(rigs, pinhole) == rigs.end()) rigs.push_back(pinhole);
  }
  return rigs;
}

CubeObservation ObserveOnCube(const Eigen::Vector3d& bearing, PinholeFace pinhole) {
  const int face = FaceOf(bearing);
  return {face, pinhole.PixelFromBearing(FaceFromCamera(face) * bearing)};
}

}  // namespace orbweave
