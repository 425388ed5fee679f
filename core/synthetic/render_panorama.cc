// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/render_panorama.h"

#include <algorithm>
#include <cmath>

#include "core/synthetic/cover_nadir.h"
#include "core/synthetic/soften_shade.h"

namespace orbweave {
namespace {

constexpr uint32_t kRoofSurface = ~0U;

/// What one ray of the camera sees; the roof hides the street.
struct Sample {
  SurfaceHit hit{};
  Eigen::Vector2d on_roof = Eigen::Vector2d::Zero();  // right and forward of the camera, metres
};

/// The carrier's roof: a rounded rectangle one metre below the camera.
constexpr double kRoofBelow_m = 1.0;
constexpr double kRoofHalfWidth_m = 0.72;
constexpr double kRoofFront_m = 0.55;
constexpr double kRoofBack_m = -1.1;

/// Signed distance of a place from the roof's outline, negative on the roof.
double FromRoof(const Eigen::Vector2d& place) {
  constexpr double kRadius_m = 0.3;
  const double middle = 0.5 * (kRoofFront_m + kRoofBack_m);
  const double half = 0.5 * (kRoofFront_m - kRoofBack_m);
  const Eigen::Vector2d q(std::abs(place.x()) - kRoofHalfWidth_m + kRadius_m,
                          std::abs(place.y() - middle) - half + kRadius_m);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - kRadius_m;
}

/// White sheet with ribs, rails and scratches.
Colour RoofColour(const Eigen::Vector2d& place, double footprint_m) {
  const double scratches = FractalNoise(place.x(), place.y(), {0.5, 0.01}, footprint_m, 4711);
  Colour colour = Colour(0.74, 0.75, 0.76) * (1.0 + 0.1 * scratches);
  for (const double x : {-0.6, -0.3, 0.0, 0.3, 0.6}) {
    const double width_m = std::abs(x) > 0.5 ? 0.04 : 0.012;
    colour =
        Mix(colour, 0.4 * colour, CoverInterval(place.x(), x - width_m, x + width_m, footprint_m));
  }
  return colour;
}

class Renderer {
 public:
  Renderer(const StreetWorld& world, const Traffic& traffic, const PanoramaView& view)
      : world_(world),
        traffic_(traffic),
        view_(view),
        rays_(view.camera, view.cam_from_street, view.lenses, view.shutter),
        shows_roof_(view.nadir == NadirKind::kRoof || view.nadir == NadirKind::kBlurred),
        pixel_rad_(view.camera.AngleFromPixels(1.0)) {}

  /// Sample and colour of a ray through an image position; `size` is the pixel's extent, below 1
  /// when several rays share a pixel.
  Colour Look(double x_px, double y_px, double size, Sample& sample) const {
    const Eigen::Vector3d bearing = view_.camera.BearingFromPixel({x_px, y_px});
    const double pixel_rad = size * pixel_rad_;
    if (bearing.y() > 0.3 && shows_roof_) {
      sample.on_roof = Eigen::Vector2d(bearing.x(), bearing.z()) * (kRoofBelow_m / bearing.y());
      if (FromRoof(sample.on_roof) < 0.0) {
        sample.hit = {.surface = kRoofSurface};
        return RoofColour(sample.on_roof, pixel_rad * kRoofBelow_m / (bearing.y() * bearing.y()));
      }
    }
    const LightRay ray = rays_.Through(bearing, y_px);
    sample.hit = Trace(world_, traffic_, ray);
    return Shade(world_, traffic_, ray, sample.hit, pixel_rad);
  }

  /// Mean over a raster of rays inside pixel (i, j).
  Colour Average(int i, int j) const {
    constexpr int kRays = 3;
    Colour sum = Colour::Zero();
    Sample sample;
    for (int b = 0; b < kRays; ++b) {
      for (int a = 0; a < kRays; ++a) {
        sum += Look(i + (a + 0.5) / kRays, j + (b + 0.5) / kRays, 1.0 / kRays, sample);
      }
    }
    return sum / (kRays * kRays);
  }

 private:
  const StreetWorld& world_;
  const Traffic& traffic_;
  const PanoramaView& view_;
  CameraRays rays_;
  bool shows_roof_;
  double pixel_rad_;
};

/// What the middles of a row's pixels see.
struct Row {
  std::vector<SurfaceHit> hits{};
  std::vector<Colour> colours{};
};

Row LookAlongRow(const Renderer& renderer, int width_px, int j) {
  Row row;
  Sample sample;
  for (int i = 0; i < width_px; ++i) {
    row.colours.push_back(renderer.Look(i + 0.5, j + 0.5, 1.0, sample));
    row.hits.push_back(sample.hit);
  }
  return row;
}

/// Whether a neighbour of pixel i shows something else; columns wrap.
bool IsEdge(const Row& above, const Row& row, const Row& below, size_t i) {
  const size_t width = row.hits.size();
  const SurfaceHit& here = row.hits[i];
  return !here.LooksLike(row.hits[(i + 1) % width]) ||
         !here.LooksLike(row.hits[(i + width - 1) % width]) || !here.LooksLike(above.hits[i]) ||
         !here.LooksLike(below.hits[i]);
}

/// Near-normal noise of unit variance: the sum of four uniform numbers.
double SensorNoise(int i, int j, uint32_t seed) {
  double sum = -2.0;
  for (uint32_t k = 0; k < 4; ++k) sum += UniformOf(i, j, seed + k);
  return sum * std::sqrt(3.0);
}

Rgb Quantise(const Colour& colour, const PanoramaView& view, int i, int j) {
  const double vignette = view.lenses.vignetting == 0.0
                              ? 1.0
                              : view.lenses.Gain(view.camera.BearingFromPixel({i + 0.5, j + 0.5}));
  const Colour gain = vignette * view.white_balance;
  uint8_t values[3];
  for (uint32_t c = 0; c < 3; ++c) {
    const double clean = 255.0 * view.exposure * (gain[c] * colour[c]);
    const double dark = std::clamp((120.0 - clean) / 120.0, 0.0, 1.0);
    const double noise_levels = view.noise_levels + dark * view.shade_noise_levels;
    const double level = clean + noise_levels * SensorNoise(i, j, view.seed + 8 * c);
    values[c] = static_cast<uint8_t>(std::clamp(std::lround(level), 0L, 255L));
  }
  return {values[0], values[1], values[2]};
}

bool IsIgnored(const SurfaceHit& hit, const PanoramaView& view) {
  return hit.surface == kRoofSurface || (hit.moving && view.mask_traffic);
}

}  // namespace

RenderedPanorama RenderPanorama(const StreetWorld& world,
                                const Traffic& traffic,
                                const PanoramaView& view) {
  const Renderer renderer(world, traffic, view);
  const int width = view.camera.width_px;
  const int height = view.camera.height_px;
  RenderedPanorama image{.camera = view.camera};
  image.pixels.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
  image.ignored.reserve(image.pixels.capacity());
  Row row = LookAlongRow(renderer, width, 0);
  Row above = row;
  for (int j = 0; j < height; ++j) {
    Row below = j + 1 < height ? LookAlongRow(renderer, width, j + 1) : row;
    for (int i = 0; i < width; ++i) {
      const auto column = static_cast<size_t>(i);
      const bool edge = IsEdge(above, row, below, column);
      const Colour colour = edge ? renderer.Average(i, j) : row.colours[column];
      image.pixels.push_back(Quantise(colour, view, i, j));
      image.ignored.push_back(IsIgnored(row.hits[column], view) ? 255 : 0);
    }
    above = std::move(row);
    row = std::move(below);
  }
  SoftenShade(image, view.shade_blur_px);
  CoverNadir(image, view.nadir);
  return image;
}

}  // namespace orbweave
