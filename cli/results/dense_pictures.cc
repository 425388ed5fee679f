// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/dense_pictures.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/drawing/draw_depth_map.h"
#include "core/drawing/draw_top_view.h"
#include "core/io/file.h"
#include "core/io/page/place_picture.h"
#include "stages/check_depths/stage.h"
#include "stages/dense_codecs.h"

namespace orbweave {
namespace {

constexpr size_t kDepthsShown = 8;
constexpr int kMaxSide_px = 2048;
constexpr double kPixelsPerBaseline = 64.0;

/// The y axis of a panorama points down. Where the mean says nothing, the world's z.
Eigen::Vector3d MeanUp(const DensePlan& plan) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const DensePanorama& panorama : plan.panoramas)
    sum -= panorama.cam_from_model.rotation.conjugate() * Eigen::Vector3d::UnitY();
  const bool agree = sum.norm() > 0.5 * static_cast<double>(plan.panoramas.size());
  return agree ? Eigen::Vector3d(sum.normalized()) : Eigen::Vector3d::UnitZ();
}

/// What an earlier run may have left.
void RemoveFiles(const std::vector<std::string>& paths) {
  std::error_code ignored;
  for (const std::string& path : paths) std::filesystem::remove(path, ignored);
}

/// Indices of maps that have a depth, evenly spread over them.
std::vector<size_t> Choose(const DenseReport& report) {
  std::vector<size_t> usable;
  for (size_t i = 0; i < report.maps.size(); ++i) {
    if (report.maps[i].coverage > 0.0) usable.push_back(i);
  }
  const size_t count = std::min(usable.size(), kDepthsShown);
  std::vector<size_t> chosen;
  for (size_t k = 0; k < count; ++k)
    chosen.push_back(usable[(2 * k + 1) * usable.size() / (2 * count)]);
  return chosen;
}

}  // namespace

double MedianStep(const DensePlan& plan) {
  std::vector<double> steps;
  for (const DensePanorama& panorama : plan.panoramas) steps.push_back(panorama.unit_m);
  return steps.empty() ? 1.0 : Quantile(std::move(steps), 0.5);
}

TopView ViewOfCloud(const DensePlan& plan, bool is_on_earth) {
  return {is_on_earth ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : MeanUp(plan),
          MedianStep(plan) / kPixelsPerBaseline,
          kMaxSide_px};
}

absl::StatusOr<std::string> WriteFromAbove(const TopPicture& picture,
                                           const std::optional<GeodeticPosition>& origin,
                                           const std::filesystem::path& folder) {
  const std::string path = (folder / "from_above.png").string();
  const std::string world_file = (folder / "from_above.pgw").string();
  const std::string frame_file = path + ".aux.xml";
  if (picture.width_px == 0) {
    RemoveFiles({path, world_file, frame_file});
    return std::string();
  }
  ORBWEAVE_ASSIGN_OR_RETURN(std::string png, DrawTopView(picture));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(path, png));
  if (!origin) {
    RemoveFiles({world_file, frame_file});
    return png;
  }
  const UtmFrame utm(*origin);
  const PicturePlace place{.width_px = picture.width_px,
                           .height_px = picture.height_px,
                           .pixel_m = picture.pixel,
                           .corner_m = picture.corner};
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(world_file, WorldFileText(place, utm)));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(frame_file, PictureFrameXml(utm)));
  return png;
}

absl::StatusOr<std::vector<DensePictures::Depth>> DrawDepthMaps(JobReader& job,
                                                                const DensePlan& plan,
                                                                const ImageManifest& manifest,
                                                                const DenseReport& report,
                                                                BlobAccess& blobs) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> maps,
                            job.List(&CheckDepthsStage::Outputs::map));
  if (maps.size() != plan.panoramas.size())
    return absl::DataLossError("not one depth map for each panorama");
  std::vector<DensePictures::Depth> pictures;
  for (const size_t i : Choose(report)) {
    const PanoramaFile& file = plan.panoramas[i].file;
    const std::string name = manifest.At(file.image).name;
    PictureImage image{.camera = file.camera};
    if (absl::StatusOr<std::string> bytes = blobs.Get(file.content); bytes.ok())
      image.encoded = *std::move(bytes);
    ORBWEAVE_ASSIGN_OR_RETURN(const DepthMap map, job.Fetch<DepthMap>(maps[i]));
    ORBWEAVE_ASSIGN_OR_RETURN(std::string jpeg,
                              DrawDepthMap(image, map, report.is_metric ? "m" : "units"));
    pictures.push_back({name, std::move(jpeg)});
  }
  return pictures;
}

}  // namespace orbweave
