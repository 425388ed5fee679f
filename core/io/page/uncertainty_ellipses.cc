// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/uncertainty_ellipses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/quantile.h"
#include "core/geometry/symmetric_eigen.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

constexpr size_t kMaxEllipses = 60;
constexpr double kWanted_px = 26.0;  // semi-axis that nine ellipses of ten stay below
constexpr double kLargest_px = 70.0;
constexpr double kSmallest_px = 0.5;

// One sigma on the page, not enlarged.
struct Ellipse {
  Eigen::Vector2d middle;
  double major_px = 0.0;
  double minor_px = 0.0;
  double turn_deg = 0.0;  // of the major axis, clockwise from the right as pages have it
};

Ellipse EllipseOf(const ReportImage& image, const MapView& view) {
  const Eigen::Matrix2d covariance =
      view.axes * image.uncertainty->position_covariance * view.axes.transpose();
  const SymmetricEigen<2> axes = EigenOf<2>(covariance);
  const Eigen::Vector2d sigmas = axes.values.cwiseMax(0.0).cwiseSqrt();
  const Eigen::Vector2d axis = axes.vectors.col(1);
  return {.middle = view.Page(image.centre_in_world),
          .major_px = sigmas[1] / view.units_per_pixel,
          .minor_px = sigmas[0] / view.units_per_pixel,
          .turn_deg = std::atan(-axis.y() / axis.x()) * 180.0 / std::numbers::pi};
}

std::vector<Ellipse> LeastCertain(const MapImages& images, const MapView& view) {
  const size_t stride = (images.size() + kMaxEllipses - 1) / kMaxEllipses;
  const auto variance = [&](const ReportImage* image) {
    if (!image->uncertainty) return -1.0;
    return (view.axes * image->uncertainty->position_covariance * view.axes.transpose()).trace();
  };
  std::vector<Ellipse> ellipses;
  for (size_t begin = 0; begin < images.size(); begin += stride) {
    const auto first = images.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto end =
        images.begin() + static_cast<std::ptrdiff_t>(std::min(begin + stride, images.size()));
    const ReportImage* worst = *std::max_element(
        first, end, [&](const auto* x, const auto* y) { return variance(x) < variance(y); });
    if (worst->uncertainty) ellipses.push_back(EllipseOf(*worst, view));
  }
  return ellipses;
}

// The largest of 1, 2 and 5 times a power of ten that leaves most ellipses small; 0: nothing to
// see.
double Enlargement(const std::vector<Ellipse>& ellipses) {
  std::vector<double> majors;
  for (const Ellipse& ellipse : ellipses) majors.push_back(ellipse.major_px);
  const double most_px = Quantile(std::move(majors), 0.9);
  if (!(most_px > 0.0)) return 0.0;
  const double wanted = kWanted_px / most_px;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  return power * (wanted >= 5.0 * power ? 5.0 : wanted >= 2.0 * power ? 2.0 : 1.0);
}

std::string Drawn(const Ellipse& ellipse, double enlargement) {
  const double major_px = ellipse.major_px * enlargement;
  if (!(major_px > kSmallest_px)) return "";
  const bool is_cut = major_px > kLargest_px;
  return absl::StrCat("<ellipse class=\"sigma",
                      is_cut ? " cut" : "",
                      "\" rx=\"",
                      DecimalText(std::min(major_px, kLargest_px), 1),
                      "\" ry=\"",
                      DecimalText(std::min(ellipse.minor_px * enlargement, kLargest_px), 1),
                      "\" transform=\"translate(",
                      DecimalText(ellipse.middle.x(), 1),
                      ",",
                      DecimalText(ellipse.middle.y(), 1),
                      ")rotate(",
                      DecimalText(ellipse.turn_deg, 0),
                      ")\"/>");
}

}  // namespace

std::string UncertaintyEllipses(const MapImages& images, const MapView& view) {
  const std::vector<Ellipse> ellipses = LeastCertain(images, view);
  if (ellipses.empty()) return "";
  const double enlargement = Enlargement(ellipses);
  std::string svg;
  for (const Ellipse& ellipse : ellipses) svg += Drawn(ellipse, enlargement);
  if (svg.empty()) return "";
  const double y = view.height - 12.0;
  return absl::StrCat(svg,
                      "<text text-anchor=\"end\" x=\"980\" y=\"",
                      DecimalText(y, 1),
                      "\">ellipses: one sigma, ",
                      enlargement == 1.0 ? "to scale" : "x " + ShortText(enlargement),
                      "</text>");
}

}  // namespace orbweave
