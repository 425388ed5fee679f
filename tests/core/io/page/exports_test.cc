// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/io/byte_stream.h"
#include "core/io/page/cameras_csv.h"
#include "core/io/page/georeference_json.h"
#include "core/io/page/measure_reconstruction.h"
#include "core/io/page/trace_json.h"
#include "core/io/page/trajectory_geojson.h"
#include "core/io/points/write_ply.h"
#include "core/io/text_fields.h"
#include "core/scene/local_frame.h"
#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

SmallScene GeoreferencedScene() {
  SmallScene scene = MakeSmallScene(12, 200);
  scene.manifest.origin = GeodeticPosition{47.61, -122.32, 60.0};
  for (ImageRecord& image : scene.manifest.images) image.drive = image.id.value / 6;
  return scene;
}

TEST(PlyWriter, HoldsEveryPointAndColour) {
  const TemporaryFolder folder;
  const SmallScene scene = MakeSmallScene(6, 50);
  PlyWriter writer(folder / "points.ply");
  for (const Track& track : scene.reconstruction.tracks) writer.Add(track);
  ASSERT_TRUE(writer.Finish().ok());
  const std::string ply = ReadFile(folder / "points.ply").value();
  const size_t body = ply.find("end_header\n") + 11;
  EXPECT_THAT(
      ply,
      HasSubstr("\nelement vertex " + std::to_string(scene.reconstruction.tracks.size()) + "\n"));
  EXPECT_THAT(ply, StartsWith("ply\nformat binary_little_endian 1.0\n"));
  ASSERT_EQ(ply.size() - body, scene.reconstruction.tracks.size() * 27);
  ByteReader in(std::string_view(ply).substr(body));
  for (const Track& track : scene.reconstruction.tracks) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(in.Take<double>(), track.point_in_world[axis]);
    EXPECT_EQ(in.Take<uint8_t>(), track.color.r);
    EXPECT_EQ(in.Take<uint8_t>(), track.color.g);
    EXPECT_EQ(in.Take<uint8_t>(), track.color.b);
  }
}

/// The scene's images in two models, of which the first is on earth. Images that the scene has no
/// pose for are missing.
JobReport ReportOf(const SmallScene& scene) {
  JobReport report;
  report.origin = scene.manifest.origin;
  report.models = 2;
  report.each_model = {{.gnss = {.used = true}}, {}};
  for (const ImageRecord& record : scene.manifest.images) {
    ReportImage& row = report.images.emplace_back();
    row.name = record.name;
    row.drive = record.drive;
    row.cluster = static_cast<int>(record.id.value / 4);
    const auto found = scene.reconstruction.images.find(record.id);
    if (found == scene.reconstruction.images.end()) continue;
    row.registered = true;
    row.loose = found->second.loose;
    row.model = record.id.value < 8 ? 0 : 1;
    row.cam_from_world = found->second.cam_from_world;
    row.centre_in_world = row.cam_from_world.Centre();
    row.uncertainty = found->second.uncertainty;
    if (row.loose) continue;
    row.observations = 100 + record.id.value;
    row.residual_px_mean = 0.5;
  }
  return report;
}

TEST(CamerasCsv, HasEveryImageOfEveryModelWithItsPoseAndMeasures) {
  SmallScene scene = GeoreferencedScene();
  scene.manifest.images[2].name = "a,\"b\".jpg";
  scene.reconstruction.images[ImageId(3)].loose = true;
  scene.reconstruction.images[ImageId(4)].uncertainty = {
      Eigen::Vector3d(4.0, 9.0, 16.0).asDiagonal(), 0.01};
  const std::string csv = CamerasCsv(ReportOf(scene));
  const std::vector<std::string_view> lines = SplitLines(csv);
  ASSERT_EQ(lines.size(), 13U);
  for (uint32_t i = 0; i < 12; ++i) {
    const std::vector<std::string> cells = SplitFields(lines[i + 1], ',');
    ASSERT_EQ(cells.size(), SplitFields(lines[0], ',').size()) << lines[i + 1];
    const bool missing = i % 10 == 1;
    EXPECT_EQ(cells[0], scene.manifest.images[i].name);
    EXPECT_EQ(cells[11], i == 3 ? "loose" : missing ? "not_registered" : "registered");
    EXPECT_EQ(cells[12], i == 4 ? "2.000000" : "");
    EXPECT_EQ(cells[14], i == 4 ? "4.000000" : "");
    EXPECT_EQ(cells[15], i == 4 ? "0.5729578" : "");
    EXPECT_EQ(cells[16], missing ? "" : i < 8 ? "0" : "1");
    EXPECT_EQ(cells[17], std::to_string(i / 4));
    EXPECT_EQ(cells[18], missing ? "" : i == 3 ? "0" : std::to_string(100 + i));
    EXPECT_EQ(cells[19], missing || i == 3 ? "" : "0.5000");
    if (missing) continue;
    const Rigid3& pose = scene.reconstruction.images.at(ImageId(i)).cam_from_world;
    double v[10] = {};
    for (size_t c = 0; c < (i < 8 ? 10U : 7U); ++c) v[c] = NumberFromText(cells[c + 1]).value();
    EXPECT_LT((Eigen::Vector3d(v[0], v[1], v[2]) - pose.Centre()).norm(), 1e-5);
    EXPECT_LT(Eigen::Quaterniond(v[3], v[4], v[5], v[6]).angularDistance(pose.rotation), 1e-7);
    EXPECT_GE(v[3], 0.0);
    if (i >= 8) {
      EXPECT_EQ(cells[8] + cells[9] + cells[10], "") << "its model is not on earth";
      continue;
    }
    EXPECT_LT((EnuFromGeodetic({v[7], v[8], v[9]}, *scene.manifest.origin) - pose.Centre()).norm(),
              1e-3);
  }
}

TEST(CamerasCsv, OfPosesAloneHasNoMeasures) {
  const SmallScene scene = GeoreferencedScene();
  const std::string csv = CamerasCsv(scene.reconstruction.images, scene.manifest, false);
  const std::string first(SplitLines(csv)[1]);
  EXPECT_THAT(first, HasSubstr(",,,,registered,,,,"));
  EXPECT_EQ(SplitFields(first, ',').size(), 16U);
  EXPECT_EQ(SplitFields(SplitLines(csv)[0], ',').size(), 16U);
}

TEST(TrajectoryGeoJson, HasALinePerPathAndAFeaturePerImage) {
  SmallScene scene = GeoreferencedScene();
  scene.reconstruction.images[ImageId(0)].uncertainty = {
      Eigen::Vector3d(4.0, 9.0, 16.0).asDiagonal(), 0.01};
  scene.reconstruction.images[ImageId(3)].loose = true;
  JobReport report = ReportOf(scene);
  report.images[1].reason = "too few points";
  report.each_model[1].gnss.reason = "no positions";
  report.paths = {{.images = {5, 0, 2, 4}},
                  {.drive = 1, .images = {6, 7}},
                  {.model = 1, .drive = 1, .images = {8, 9, 10}}};
  const auto json = nlohmann::json::parse(TrajectoryGeoJson(report).value());
  EXPECT_EQ(json["type"], "FeatureCollection");
  ASSERT_EQ(json["features"].size(), 2 + 12U);
  EXPECT_EQ(json["features"][0]["geometry"]["type"], "LineString");
  EXPECT_EQ(json["features"][0]["geometry"]["coordinates"].size(), 4U);
  EXPECT_EQ(json["features"][0]["geometry"]["coordinates"][1],
            json["features"][2]["geometry"]["coordinates"]);
  EXPECT_EQ(json["features"][1]["properties"]["drive"], 1);
  const auto& point = json["features"][2];
  EXPECT_EQ(point["properties"]["name"], "street/img0.jpg");
  EXPECT_EQ(point["properties"]["sigma_north_m"], 3.0);
  EXPECT_EQ(point["properties"]["model"], 0);
  EXPECT_EQ(point["properties"]["cluster"], 0);
  EXPECT_EQ(point["properties"]["observations"], 100);
  EXPECT_EQ(point["properties"]["residual_px"], 0.5);
  EXPECT_EQ(point["properties"]["state"], "registered");
  EXPECT_FALSE(point["properties"].contains("reason"));
  const auto& missing = json["features"][3];
  EXPECT_TRUE(missing["geometry"].is_null());
  EXPECT_EQ(missing["properties"]["name"], "street/img1.jpg");
  EXPECT_EQ(missing["properties"]["state"], "not_registered");
  EXPECT_EQ(missing["properties"]["reason"], "too few points");
  EXPECT_FALSE(missing["properties"].contains("model"));
  EXPECT_FALSE(json["features"][4]["properties"].contains("sigma_north_m"));
  EXPECT_EQ(json["features"][5]["properties"]["state"], "loose");
  EXPECT_EQ(json["features"][5]["geometry"]["type"], "Point");
  const auto& elsewhere = json["features"][2 + 8];
  EXPECT_TRUE(elsewhere["geometry"].is_null()) << "its model is not on earth";
  EXPECT_EQ(elsewhere["properties"]["state"], "registered");
  EXPECT_EQ(elsewhere["properties"]["model"], 1);
  EXPECT_EQ(elsewhere["properties"]["reason"], "its model is not georeferenced: no positions");
  const auto& position = point["geometry"]["coordinates"];
  const Eigen::Vector3d enu =
      EnuFromGeodetic({position[1], position[0], position[2]}, *scene.manifest.origin);
  EXPECT_LT((enu - scene.reconstruction.images.at(ImageId(0)).cam_from_world.Centre()).norm(),
            1e-3);
  report.each_model[1].gnss.used = true;
  const auto both = nlohmann::json::parse(TrajectoryGeoJson(report).value());
  EXPECT_EQ(both["features"].size(), 3 + 12U);
  EXPECT_EQ(both["features"][3 + 8]["geometry"]["type"], "Point");
  EXPECT_EQ(TrajectoryGeoJson({}).status().code(), absl::StatusCode::kFailedPrecondition);
}

TEST(GeoreferenceJson, PlacesTheFrameOnTheEarth) {
  const SmallScene scene = GeoreferencedScene();
  const auto json = nlohmann::json::parse(GeoreferenceJson(scene.manifest, {0, 2}));
  EXPECT_EQ(json["axes"], "east-north-up");
  EXPECT_EQ(json["models"], nlohmann::json::array({0, 2}));
  EXPECT_EQ(json["unit"], "metre");
  EXPECT_DOUBLE_EQ(json["origin"]["latitude"], 47.61);
  const auto& M = json["ecef_from_enu"];
  const Eigen::Vector3d up(M[0][2], M[1][2], M[2][2]);
  const double latitude = 47.61 * M_PI / 180.0;
  EXPECT_NEAR(up.z(), std::sin(latitude), 1e-12);
  EXPECT_NEAR(Eigen::Vector3d(M[0][3], M[1][3], M[2][3]).norm(), 6.3667e6, 3e3);
  EXPECT_EQ(nlohmann::json::parse(GeoreferenceJson(scene.manifest, {}))["georeferenced"], false);
}

ReconstructionMeasures Measured(const Reconstruction& model, const ImageManifest& manifest) {
  ReconstructionMeter meter(model.images, manifest);
  for (const Track& track : model.tracks) meter.Add(track);
  return std::move(meter).Finish();
}

TEST(ReconstructionMeter, CountsAndMeasures) {
  SmallScene scene = MakeSmallScene(12, 200);
  ReconstructionMeasures measures = Measured(scene.reconstruction, scene.manifest);
  EXPECT_EQ(measures.points, scene.reconstruction.tracks.size());
  EXPECT_EQ(measures.observations, scene.reconstruction.NumObservations());
  EXPECT_LT(measures.residual_px_rms, 1e-6);
  EXPECT_EQ(measures.residual_histogram.counts[0], measures.observations);
  // Turn every bearing by 1.05 pixels of the wider camera.
  const double angle = 1.05 / 2048.0 * 2.0 * M_PI;
  for (Track& track : scene.reconstruction.tracks) {
    for (Observation& observation : track.observations) {
      const Eigen::Vector3d side = TangentBasis(observation.bearing).col(0);
      observation.bearing = std::cos(angle) * observation.bearing + std::sin(angle) * side;
    }
  }
  measures = Measured(scene.reconstruction, scene.manifest);
  uint64_t wide = 0;
  uint64_t total = 0;
  for (const auto& [id, image] : measures.images) {
    const bool is_wide = scene.manifest.At(id).camera.width_px == 2048;
    EXPECT_NEAR(image.residual_px_mean, is_wide ? 1.05 : 0.525, 1e-9);
    wide += is_wide ? image.observations : 0;
    total += image.observations;
  }
  EXPECT_EQ(total, measures.observations);
  EXPECT_EQ(measures.residual_histogram.counts[10], wide);
  EXPECT_EQ(measures.residual_histogram.counts[5], total - wide);
  EXPECT_EQ(Measured({}, {}).mean_track_length, 0.0);
}

TEST(TraceJson, HasALanePerSlotAndDoesNotDependOnOrder) {
  const std::vector<TraceRow> rows = {{"extract", 0, "w2", 0, 0.0, 1.5, true},
                                      {"extract", 1, "w10", 1, 0.25, 2.0, false},
                                      {"match", 0, "w2", 0, 2.0, 3.0, true}};
  const std::string text = TraceJson(rows);
  EXPECT_EQ(text, TraceJson({rows[2], rows[0], rows[1]}));
  const auto events = nlohmann::json::parse(text)["traceEvents"];
  ASSERT_EQ(events.size(), 4 + 3U);
  EXPECT_EQ(events[0]["args"]["name"], "w2");  // natural order: w2 before w10
  EXPECT_EQ(events[2]["args"]["name"], "w10");
  EXPECT_EQ(events[3]["args"]["name"], "slot 1");
  EXPECT_EQ(events[5]["name"], "extract 1");
  EXPECT_EQ(events[5]["ts"], 250000);
  EXPECT_EQ(events[5]["dur"], 1750000);
  EXPECT_EQ(events[5]["tid"], 1);
}

}  // namespace
}  // namespace orbweave
