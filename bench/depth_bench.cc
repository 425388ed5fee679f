// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// Depth maps of the built-in street against its true surface, with true poses, on one thread:
///
///   bench_depth [--panoramas 5] [--width 2048] [--spacing 2.5] [--seed 1] [--realistic] [--exact]
///               [--judged 3] [--reach 4] [--seeds 400] [--kernel 0|1|2]
///               [--set key=value] [--pictures FOLDER] [--images FOLDER]
///
/// Surface counts that the truth has 2 to 15 m away and that another panorama sees as near. A point
/// is as wrong as it is away from the true surface (tangent planes of what the rays around its own
/// hit). Panes that mirror and what moves (traffic, crowns in the wind) are judged apart.
/// --realistic has all hardships of a town's street; --exact takes away those that no pose
/// explains, lenses beside the panorama's centre and the rolling shutter.

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "bench/depth_score.h"
#include "bench/street_truth.h"
#include "core/base/random.h"
#include "core/dense/check_depths.h"
#include "core/dense/equiangular_raster.h"
#include "core/dense/estimate_depths.h"
#include "core/dense/evaluate_surface.h"
#include "core/dense/fuse_pixels.h"
#include "core/dense/match_scale.h"
#include "core/geometry/cube_face.h"
#include "core/synthetic/make_street.h"
#include "core/synthetic/realistic_street.h"
#include "core/synthetic/render_street_panorama.h"

namespace orbweave {
namespace {

struct Arguments {
  StreetOptions street{.panoramas = 5};
  DenseOptions dense{};
  bool realistic = false;
  bool exact = false;
  int judged = 3;
  int reach = 4;
  int seeds = 400;
  int kernel = -1;
  std::string pictures{};
  std::string images{};
};

double CpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A panorama with what is known of it.
struct Shot {
  size_t index = 0;
  RenderedPanorama image{};
  std::vector<uint8_t> pixels{};
  Rigid3 cam_from_street{};

  [[nodiscard]] PanoramaRaster Raster() const {
    return {image.camera.width_px, image.camera.height_px, 3, pixels, image.ignored};
  }
};

const char* NameOf(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::kGlass:
      return "glass";
    case SurfaceKind::kMoves:
      return "what moves";
    default:
      return "still";
  }
}

class Bench {
 public:
  explicit Bench(const Arguments& arguments)
      : arguments_(arguments),
        street_(MakeStreet(arguments.street)),
        surface_(street_, arguments.street) {
    const double before_s = CpuSeconds();
    for (int k = 0; k < arguments_.street.panoramas; ++k)
      shots_.push_back(Render(static_cast<size_t>(k)));
    std::printf("rendered %zu panoramas in %.1f CPU s\n", shots_.size(), CpuSeconds() - before_s);
  }

  void Run() {
    TimeKernels();
    EstimateAll();
    std::vector<Eigen::Vector3d> cloud;
    std::vector<Eigen::Vector3d> surface;
    double check_s = 0.0;
    std::vector<RasterTruth> truths(shots_.size());
    std::vector<DepthMap> checked;
    for (size_t own = 0; own < shots_.size(); ++own) {
      std::vector<NeighbourMap> neighbours;
      for (const size_t other : SourcesOf(own)) {
        neighbours.push_back(
            {&maps_[other], shots_[other].cam_from_street * shots_[own].cam_from_street.Inverse()});
      }
      const double before_s = CpuSeconds();
      const DepthMap& map =
          checked.emplace_back(CheckDepths(maps_[own], neighbours, arguments_.dense));
      check_s += CpuSeconds() - before_s;
      Append(map, own, cloud);
      const bool judged =
          own >= FirstJudged() && own < FirstJudged() + static_cast<size_t>(arguments_.judged);
      if (!judged) continue;
      const RasterTruth& truth = truths[own] = surface_.Of(own, SourcesOf(own), map.face_px);
      pose_ = &shots_[own].cam_from_street;
      std::printf("panorama %zu\n", own);
      const auto is_still = [&](size_t k) { return truth.kinds[k] == SurfaceKind::kStill; };
      Judge("estimated, still", maps_[own], truth, is_still);
      Judge("checked, still", map, truth, is_still);
      JudgeParts(map, truth);
      Draw("estimated_" + std::to_string(own), maps_[own], truth);
      Draw("checked_" + std::to_string(own), map, truth);
      for (size_t k = 0; k < truth.points.size(); ++k) {
        if (truth.counts[k] != 0 && truth.kinds[k] == SurfaceKind::kStill)
          surface.push_back(truth.points[k].cast<double>());
      }
    }
    JudgeFused(checked, truths);
    const SurfaceEvaluation evaluation = EvaluateSurface(cloud, surface);
    std::printf("checked in %.2f CPU s each; recall of the cloud",
                check_s / static_cast<double>(shots_.size()));
    for (const SurfaceScore& score : evaluation.scores) std::printf(" %5.1f", 100.0 * score.recall);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("\npeak memory of all %.0f MB\n", static_cast<double>(usage.ru_maxrss) / 1024.0);
  }

 private:
  size_t FirstJudged() const {
    return static_cast<size_t>(std::max(0, (arguments_.street.panoramas - arguments_.judged) / 2));
  }

  /// Nanoseconds per correlation of a pixel, over the front face of the first panorama, through
  /// level planes 3 m away.
  void TimeKernels() const {
    const std::vector<GreyPanorama> sources = {MakeGreyPanorama(shots_.at(1).Raster())};
    const std::vector<Rigid3> poses = {shots_[1].cam_from_street *
                                       shots_[0].cam_from_street.Inverse()};
    const MatchScale scale(MakeGreyPanorama(shots_[0].Raster()), sources, poses, 0);
    PlaneLanes planes;
    planes.z.fill(1.0F / 3.0F);
    std::printf("ns per ZNCC:");
    for (const MatchKernel kernel : AvailableMatchKernels()) {
      const MatchFunction match = MatchFunctionOf(kernel);
      constexpr int kRepeats = 8;
      ReferencePatches patches;
      LaneFloats zncc{};
      double sum = 0.0;
      double count = 0.0;
      const double before_s = CpuSeconds();
      for (int row = ReferenceRaster::kApron_px; row < scale.raster.face_px; row += 4) {
        for (int column = ReferenceRaster::kApron_px; column < scale.raster.face_px - 32;
             column += 32) {
          PreparePatches(scale, {0, row, column}, patches);
          for (int repeat = 0; repeat < kRepeats; ++repeat) {
            planes.x.fill(0.01F * static_cast<float>(repeat));
            match(patches, scale.views[0][0], planes, 1.0F, zncc);
            sum += zncc[0];
            count += kMatchLanes;
          }
        }
      }
      std::printf(" %.1f", 1e9 * (CpuSeconds() - before_s) / count);
      if (sum == 0.5) std::printf("!");  // the sum is used
    }
    std::printf(" (portable, AVX2, AVX-512 as available)\n");
  }

  void EstimateAll() {
    const std::vector<MatchKernel> kernels = AvailableMatchKernels();
    const MatchKernel kernel =
        arguments_.kernel < 0 ? kernels.back() : kernels.at(static_cast<size_t>(arguments_.kernel));
    const double before_s = CpuSeconds();
    for (size_t own = 0; own < shots_.size(); ++own) {
      maps_.push_back(EstimateDepths(ProblemOf(own), arguments_.dense, kernel));
      if (!maps_.back().problem.empty()) std::printf("%s\n", maps_.back().problem.c_str());
    }
    const double cpu_s = (CpuSeconds() - before_s) / static_cast<double>(shots_.size());
    const EquiangularRaster raster{arguments_.street.width_px / 4};
    const auto pixels = static_cast<double>(raster.NumPixels());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf(
        "estimated in %.2f CPU s each: %.2f s/MP of raster, %.2f s/MP of panorama; peak memory "
        "%.0f MB with all images\n",
        cpu_s,
        1e6 * cpu_s / pixels,
        0.75e6 * cpu_s / pixels,
        static_cast<double>(usage.ru_maxrss) / 1024.0);
  }

  void Append(const DepthMap& map, size_t own, std::vector<Eigen::Vector3d>& cloud) const {
    const EquiangularRaster raster{map.face_px};
    const Rigid3 street_from_cam = shots_[own].cam_from_street.Inverse();
    size_t k = 0;
    for (int face = 0; face < kCubeFaces && map.face_px > 0; ++face) {
      for (int row = 0; row < map.face_px; ++row) {
        for (int column = 0; column < map.face_px; ++column, ++k) {
          if (!(map.range_m[k] > 0.0F) || map.range_m[k] > 20.0F) continue;
          cloud.push_back(street_from_cam *
                          (static_cast<double>(map.range_m[k]) *
                           raster.BearingFromPixel(face, row + 0.5, column + 0.5)));
        }
      }
    }
  }

  std::string CacheName(size_t i) const {
    return arguments_.images + "/" + (arguments_.realistic ? (arguments_.exact ? "e" : "r") : "p") +
           std::to_string(arguments_.street.seed) + "_" +
           std::to_string(arguments_.street.width_px) + "_" +
           std::to_string(static_cast<int>(arguments_.street.spacing_m * 1000)) + "_" +
           std::to_string(arguments_.street.panoramas) + "_" + std::to_string(i) + ".raw";
  }

  Shot Render(size_t i) const {
    Shot shot{.index = i};
    shot.cam_from_street = surface_.CamFromStreet(i);
    const int width = arguments_.street.width_px;
    const auto count = static_cast<size_t>(width) * static_cast<size_t>(width / 2);
    if (!arguments_.images.empty()) {
      std::ifstream stream(CacheName(i), std::ios::binary);
      shot.pixels.resize(3 * count);
      shot.image.ignored.resize(count);
      shot.image.camera = {width, width / 2};
      stream.read(reinterpret_cast<char*>(shot.pixels.data()),
                  static_cast<std::streamsize>(3 * count));
      stream.read(reinterpret_cast<char*>(shot.image.ignored.data()),
                  static_cast<std::streamsize>(count));
      if (stream) return shot;
      shot.pixels.clear();
    }
    shot.image = RenderStreetPanorama(street_, arguments_.street, i);
    shot.pixels.reserve(3 * count);
    for (const Rgb& pixel : shot.image.pixels)
      shot.pixels.insert(shot.pixels.end(), {pixel.r, pixel.g, pixel.b});
    shot.image.pixels.clear();
    if (!arguments_.images.empty()) {
      std::ofstream stream(CacheName(i), std::ios::binary);
      stream.write(reinterpret_cast<const char*>(shot.pixels.data()),
                   static_cast<std::streamsize>(3 * count));
      stream.write(reinterpret_cast<const char*>(shot.image.ignored.data()),
                   static_cast<std::streamsize>(count));
    }
    return shot;
  }

  std::vector<size_t> SourcesOf(size_t own) const {
    std::vector<size_t> sources;
    for (int step = 1; step <= arguments_.reach; ++step) {
      for (const int sign : {1, -1}) {
        const int other = static_cast<int>(own) + sign * step;
        if (other >= 0 && other < static_cast<int>(shots_.size()))
          sources.push_back(static_cast<size_t>(other));
      }
    }
    return sources;
  }

  DepthProblem ProblemOf(size_t own) const {
    DepthProblem problem{
        .reference = shots_[own].Raster(), .min_range_m = 1.0, .max_range_m = 80.0, .seed = own};
    for (const size_t other : SourcesOf(own)) {
      problem.sources.push_back(
          {shots_[other].Raster(),
           shots_[other].cam_from_street * shots_[own].cam_from_street.Inverse()});
    }
    Random random(own + 17);
    for (int k = 0; k < arguments_.seeds; ++k) {
      const Eigen::Vector3d bearing =
          Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
      const SurfaceHit hit = surface_.TraceFrom(own, bearing);
      if (hit.surface == SurfaceHit::kSky) continue;
      const bool wild = random.Uniform() < 0.05;
      const double range_m =
          hit.distance_m * (wild ? random.Uniform(0.3, 3.0) : 1.0 + 0.01 * random.Normal());
      problem.seeds.push_back({bearing, range_m, 0.01 * range_m});
    }
    return problem;
  }

  /// Points of the cloud that judged panoramas give, each on the ray of its own pixel.
  void JudgeFused(const std::vector<DepthMap>& maps, const std::vector<RasterTruth>& truths) const {
    std::vector<PosedDepthMap> posed;
    for (size_t i = 0; i < maps.size(); ++i)
      posed.push_back({ImageId(static_cast<uint32_t>(i)), &maps[i], shots_[i].cam_from_street});
    std::array<DepthScore, kSurfaceKinds.size()> scores;
    DepthScore level;
    DepthScore other;
    for (size_t own = 0; own < maps.size(); ++own) {
      const RasterTruth& truth = truths[own];
      if (truth.points.empty()) continue;
      std::vector<PosedDepthMap> neighbours = posed;
      neighbours.erase(neighbours.begin() + static_cast<ptrdiff_t>(own));
      const EquiangularRaster raster{maps[own].face_px};
      for (const SurfacePoint& point :
           FusePixels(posed[own], shots_[own].Raster(), neighbours).points) {
        const Eigen::Vector3d in_cam = shots_[own].cam_from_street * point.position_in_world;
        const EquiangularRaster::Place place = raster.PixelFromBearing(in_cam);
        const size_t k = raster.Index(place);
        if (!truth.IsNear(k) && !IsJudged(in_cam.norm())) continue;
        const double error_m = truth.ErrorAt(place.face,
                                             static_cast<int>(place.row),
                                             static_cast<int>(place.column),
                                             point.position_in_world.cast<float>());
        const double along_m = std::abs(in_cam.norm() - static_cast<double>(truth.range_m[k]));
        scores[static_cast<size_t>(truth.kinds[k])].AddPoint(error_m, along_m, point.sigma_m);
        if (truth.kinds[k] != SurfaceKind::kStill) continue;
        (IsLevel(truth, k) ? level : other).AddPoint(error_m, along_m, point.sigma_m);
      }
    }
    std::printf("fused\n");
    for (const SurfaceKind kind : kSurfaceKinds)
      scores[static_cast<size_t>(kind)].Print(NameOf(kind));
    level.Print("  still, level");
    other.Print("  still, other");
  }

  /// Level surface is road, kerbs and roofs of cars; the rest walls and what stands before them.
  static bool IsLevel(const RasterTruth& truth, size_t pixel) {
    return std::abs(truth.normals[pixel].z()) > 0.9F;
  }

  void JudgeParts(const DepthMap& map, const RasterTruth& truth) const {
    const auto is_level = [&](size_t k) { return IsLevel(truth, k); };
    const auto is_still = [&](size_t k) { return truth.kinds[k] == SurfaceKind::kStill; };
    Judge("  still, level", map, truth, [&](size_t k) { return is_still(k) && is_level(k); });
    Judge("  still, other", map, truth, [&](size_t k) { return is_still(k) && !is_level(k); });
    Judge("  glass", map, truth, [&](size_t k) { return truth.kinds[k] == SurfaceKind::kGlass; });
    Judge("  what moves", map, truth, [&](size_t k) {
      return truth.kinds[k] == SurfaceKind::kMoves;
    });
  }

  /// Of the pixels for which `belongs(k)`.
  template <typename Belongs>
  void Judge(const char* what,
             const DepthMap& map,
             const RasterTruth& truth,
             Belongs&& belongs) const {
    const EquiangularRaster raster{map.face_px};
    DepthScore score;
    for (int face = 0; face < kCubeFaces; ++face) {
      for (int row = 1; row < map.face_px; row += 4) {
        for (int column = 1; column < map.face_px; column += 4) {
          const size_t k = raster.Index(face, row, column);
          if (!belongs(k)) continue;
          const bool is_found = map.range_m[k] > 0.0F;
          const double error_m = is_found ? ErrorOf(truth, map, face, row, column) : -1.0;
          const bool counts = truth.counts[k] != 0;
          if (counts) score.AddPlace(error_m);
          // An invented point counts against precision where it claims to be near.
          if (!is_found || (!counts && (truth.IsNear(k) || !IsJudged(map.range_m[k])))) continue;
          score.AddPoint(error_m,
                         std::abs(map.range_m[k] - truth.range_m[k]),
                         static_cast<double>(map.sigma_m[k]));
        }
      }
    }
    score.Print(what);
  }

  double ErrorOf(
      const RasterTruth& truth, const DepthMap& map, int face, int row, int column) const {
    const EquiangularRaster raster{map.face_px};
    const size_t k = raster.Index(face, row, column);
    const Eigen::Vector3d in_cam = static_cast<double>(map.range_m[k]) *
                                   raster.BearingFromPixel(face, row + 0.5, column + 0.5);
    const Eigen::Vector3d point = pose_->Inverse() * in_cam;
    return truth.ErrorAt(face, row, column, point.cast<float>());
  }

  /// Faces side by side: the ranges found, the true ones, errors (white: 10 cm and more).
  void Draw(const std::string& name, const DepthMap& map, const RasterTruth& truth) const {
    if (arguments_.pictures.empty()) return;
    const EquiangularRaster raster{map.face_px};
    const int width = map.face_px * kCubeFaces;
    std::ofstream stream(arguments_.pictures + "/" + name + ".pgm", std::ios::binary);
    stream << "P5\n" << width << " " << 3 * map.face_px << "\n255\n";
    for (int part = 0; part < 3; ++part) {
      for (int row = 0; row < map.face_px; ++row) {
        for (int column = 0; column < width; ++column) {
          const size_t k = raster.Index(column / map.face_px, row, column % map.face_px);
          const float range_m = part == 1 ? truth.range_m[k] : map.range_m[k];
          double level =
              range_m > 0.0F ? 255.0 * std::min(1.0, 1.5 / static_cast<double>(range_m)) : 0.0;
          if (part == 2) {
            level = 0.0;
            if (map.range_m[k] > 0.0F)
              level = 40.0 +
                      2150.0 *
                          std::min(
                              0.1,
                              ErrorOf(truth, map, column / map.face_px, row, column % map.face_px));
          }
          stream.put(static_cast<char>(static_cast<uint8_t>(level)));
        }
      }
    }
  }

  Arguments arguments_;
  Street street_;
  StreetTruth surface_;
  std::vector<Shot> shots_{};
  std::vector<DepthMap> maps_{};
  const Rigid3* pose_ = nullptr;
};

Arguments Parse(int count, char** values) {
  Arguments arguments;
  for (int k = 1; k < count; ++k) {
    const std::string name = values[k];
    if (name == "--realistic") {
      arguments.realistic = true;
      continue;
    }
    if (name == "--exact") {
      arguments.exact = true;
      continue;
    }
    const std::string value = k + 1 < count ? values[++k] : "";
    if (name == "--panoramas") arguments.street.panoramas = std::atoi(value.c_str());
    if (name == "--width") arguments.street.width_px = std::atoi(value.c_str());
    if (name == "--spacing") arguments.street.spacing_m = std::atof(value.c_str());
    if (name == "--seed") arguments.street.seed = std::atoi(value.c_str());
    if (name == "--judged") arguments.judged = std::atoi(value.c_str());
    if (name == "--reach") arguments.reach = std::atoi(value.c_str());
    if (name == "--seeds") arguments.seeds = std::atoi(value.c_str());
    if (name == "--kernel") arguments.kernel = std::atoi(value.c_str());
    if (name == "--pictures") arguments.pictures = value;
    if (name == "--images") arguments.images = value;
    if (name == "--set") {
      const auto at = value.find('=');
      const absl::Status status =
          SetOption(arguments.dense, value.substr(0, at), value.substr(at + 1));
      if (!status.ok()) std::printf("%s\n", std::string(status.message()).c_str());
    }
  }
  if (arguments.realistic) arguments.street = RealisticStreet(arguments.street);
  if (arguments.exact) {
    arguments.street.hardships.lens_offset_m = 0.0;
    arguments.street.hardships.rolling_shutter_s = 0.0;
  }
  return arguments;
}

}  // namespace
}  // namespace orbweave

int main(int count, char** values) {
  orbweave::Bench(orbweave::Parse(count, values)).Run();
  return 0;
}
