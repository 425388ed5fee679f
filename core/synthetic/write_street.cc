// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/write_street.h"

#include <atomic>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/parallel_for.h"
#include "core/base/random.h"
#include "core/base/status.h"
#include "core/pictures/encode_picture.h"
#include "core/scene/local_frame.h"
#include "core/synthetic/make_street.h"
#include "core/synthetic/render_street_panorama.h"
#include "core/synthetic/sample_surface.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

absl::Status WriteText(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) return absl::UnavailableError("cannot write " + path.string());
  return absl::OkStatus();
}

absl::Status WriteImage(const fs::path& path, const absl::StatusOr<std::string>& encoded) {
  if (!encoded.ok()) return Annotate(encoded.status(), path.string());
  return WriteText(path, *encoded);
}

absl::Status WritePanorama(RenderedPanorama panorama,
                           const std::string& name,
                           int jpeg_quality,
                           const fs::path& folder) {
  const int width = panorama.camera.width_px;
  const int height = panorama.camera.height_px;
  const cv::Mat rgb(height, width, CV_8UC3, panorama.pixels.data());
  const cv::Mat mask(height, width, CV_8UC1, panorama.ignored.data());
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  ORBWEAVE_RETURN_IF_ERROR(WriteImage(folder / "images" / name, EncodeJpeg(bgr, jpeg_quality)));
  return WriteImage(folder / "masks" / fs::path(name).replace_extension(".png"), EncodePng(mask));
}

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string Line(const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof(line), format, arguments);
  va_end(arguments);
  return line;
}

std::string TruthCsv(const Street& street) {
  std::string csv = "name,x,y,z,qw,qx,qy,qz\n";
  for (size_t i = 0; i < street.names.size(); ++i) {
    const Eigen::Vector3d c = street.cams_from_enu[i].Centre();
    const Eigen::Quaterniond& q = street.cams_from_enu[i].rotation;
    csv += Line("%s,%.6f,%.6f,%.6f,%.12f,%.12f,%.12f,%.12f\n",
                street.names[i].c_str(),
                c.x(),
                c.y(),
                c.z(),
                q.w(),
                q.x(),
                q.y(),
                q.z());
  }
  return csv;
}

/// Azimuth of the image centre, clockwise from north.
double HeadingDeg(const Rigid3& cam_from_enu) {
  const Eigen::Vector3d forward = cam_from_enu.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  return std::atan2(forward.x(), forward.y()) * 180.0 / std::numbers::pi;
}

std::string GnssCsv(const Street& street, const StreetOptions& options) {
  constexpr double kHeadingSigma_deg = 2.0;
  Random random("street/heading/" + std::to_string(options.seed));
  // Who recorded on two days has times of capture and a name for each drive.
  const bool two_days = street.second_day.has_value();
  std::string csv = "name,latitude,longitude,altitude,accuracy,heading";
  csv += two_days ? ",time,drive\n" : "\n";
  for (size_t i = 0; i < street.names.size(); ++i) {
    const double heading =
        HeadingDeg(street.cams_from_enu[i]) + kHeadingSigma_deg * random.Normal() + 360.0;
    if (!street.measured_in_enu[i]) continue;
    const GeodeticPosition p = GeodeticFromEnu(*street.measured_in_enu[i], street.origin);
    csv += Line("%s,%.9f,%.9f,%.4f,%.2f,%.1f",
                street.names[i].c_str(),
                p.latitude_deg,
                p.longitude_deg,
                p.altitude_m,
                std::max(0.5, options.gnss_sigma_m),
                std::fmod(heading, 360.0));
    if (two_days) {
      csv += Line(",%.3f,day%d", street.capture_times_s[i], street.on_second_day[i] ? 2 : 1);
    }
    csv += "\n";
  }
  return csv;
}

std::string OriginJson(const GeodeticPosition& origin) {
  return Line(
      "{\n  \"latitude\": %.9f,\n  \"longitude\": %.9f,\n  \"altitude\": %.4f,\n"
      "  \"axes\": \"east north up\",\n  \"unit\": \"metre\"\n}\n",
      origin.latitude_deg,
      origin.longitude_deg,
      origin.altitude_m);
}

/// Samples from all panoramas, in order.
SurfaceSamples SampleStreet(const Street& street, const StageContext& context) {
  constexpr int kColumns = 192;
  std::vector<SurfaceSamples> parts(street.names.size());
  ParallelFor(parts.size(), context.num_threads, [&](size_t i) {
    if (!context.stop.stop_requested()) parts[i] = SampleSurface(street, i, kColumns);
  });
  SurfaceSamples all;
  for (const SurfaceSamples& part : parts) {
    all.points_in_enu.insert(
        all.points_in_enu.end(), part.points_in_enu.begin(), part.points_in_enu.end());
    all.colors.insert(all.colors.end(), part.colors.begin(), part.colors.end());
  }
  return all;
}

absl::Status WritePanoramas(const Street& street,
                            const StreetOptions& options,
                            const fs::path& folder,
                            const StageContext& context) {
  const size_t n = street.names.size();
  std::vector<absl::Status> statuses(n);
  std::atomic<size_t> done = 0;
  ParallelFor(n, context.num_threads, [&](size_t i) {
    statuses[i] = context.CheckStop();
    if (!statuses[i].ok()) return;
    statuses[i] = WritePanorama(RenderStreetPanorama(street, options, i),
                                street.names[i],
                                options.hardships.jpeg_quality,
                                folder);
    context.Report(++done, n, "panoramas");
  });
  for (const absl::Status& status : statuses) ORBWEAVE_RETURN_IF_ERROR(status);
  return absl::OkStatus();
}

}  // namespace

absl::Status WriteStreet(const StreetOptions& options,
                         const std::string& output_dir,
                         const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(ValidateOptions("street", options));
  ORBWEAVE_RETURN_IF_ERROR(ValidateOptions("street", options.hardships));
  const fs::path folder(output_dir);
  for (const char* part : {"images", "masks"}) {
    std::error_code error;
    fs::create_directories(folder / part, error);
    if (error)
      return absl::UnavailableError("cannot make " + (folder / part).string() + ": " +
                                    error.message());
  }
  const Street street = MakeStreet(options);
  ORBWEAVE_RETURN_IF_ERROR(WritePanoramas(street, options, folder, context));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteText(folder / "surface.ply", PlyFromSamples(SampleStreet(street, context))));
  ORBWEAVE_RETURN_IF_ERROR(WriteText(folder / "gnss.csv", GnssCsv(street, options)));
  ORBWEAVE_RETURN_IF_ERROR(WriteText(folder / "truth_origin.json", OriginJson(street.origin)));
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  return WriteText(folder / "truth.csv", TruthCsv(street));  // last: its presence says complete
}

}  // namespace orbweave
