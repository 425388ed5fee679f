// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/sqlite_journal.h"
#include "core/io/colmap/colmap_model_writer.h"
#include "core/io/colmap/write_colmap_database.h"
#include "core/io/sqlite_connection.h"
#include "tests/fuzz/artifact_values.h"
#include "tests/fuzz/round_trip.h"
#include "tests/fuzz/seeds.h"

namespace orbweave {
namespace {

/// The images of TwoViewsOfAPoint and one between them.
ImageManifest ThreeImages() {
  ImageManifest manifest;
  for (uint32_t i = 0; i < 3; ++i) {
    manifest.images.push_back(
        {.id = ImageId(i), .name = std::to_string(i) + ".jpg", .camera = {64, 32}});
  }
  manifest.images[0].prior.geodetic = GeodeticPosition{47.0, 8.0, 400.0};
  return manifest;
}

/// The three files one after the other, each behind its size.
std::string ModelFiles(const std::string& folder) {
  const Reconstruction scene = TwoViewsOfAPoint();
  const ImageManifest manifest = ThreeImages();
  ColmapModelWriter writer(folder, scene.images, manifest);
  for (const Track& track : scene.tracks) writer.AddPoint(track);
  for (const auto& [id, image] : scene.images)
    writer.AddImage(id, std::vector<Keypoint>(5, {1.0F, 2.0F, 1.0F, 0.0F}));
  ORBWEAVE_CHECK(writer.Finish().ok());
  std::string files;
  for (const char* name : {"/cameras.bin", "/images.bin", "/points3D.bin"}) {
    const std::string bytes = *ReadFile(folder + name);
    files += static_cast<char>(bytes.size() / 256);
    files += static_cast<char>(bytes.size() % 256);
    files += bytes;
  }
  return files;
}

/// The bytes of a database after `sql`, with pages as small as can be.
std::string AfterSql(const std::string& path, const std::string& sql) {
  {
    const auto database = SqliteConnection::OpenToWrite(path);
    ORBWEAVE_CHECK(database.ok());
    for (const std::string& command : {sql,
                                       std::string("PRAGMA journal_mode=DELETE"),
                                       std::string("PRAGMA page_size=512"),
                                       std::string("VACUUM")})
      ORBWEAVE_CHECK(database->Execute(command).ok());
  }
  return *ReadFile(path);
}

std::string DatabaseFile(const std::string& folder, const std::string& damage) {
  const Features features{.camera = {64, 32},
                          .keypoints = {{1.0F, 2.0F, 1.0F, 0.0F}, {3.0F, 4.0F, 1.0F, 0.0F}},
                          .sigma_rad = {1e-3F, 1e-3F},
                          .colors = {{}, {}}};
  TwoViewGeometry pair{.pair = {ImageId(0), ImageId(2)}, .kind = TwoViewKind::kGeneral};
  pair.b_from_a.translation = Eigen::Vector3d::UnitX();
  pair.inliers = {{0, 1}};
  const std::string path = folder + "/database.db";
  ORBWEAVE_CHECK(WriteColmapDatabase(path, ThreeImages(), {3, features}, {pair}).ok());
  return AfterSql(path, damage);
}

std::string JournalFile(const std::string& folder) {
  const std::string path = folder + "/journal.db";
  {
    const auto journal = OpenSqliteJournal(path);
    ORBWEAVE_CHECK(journal.ok());
    const Digest task = DigestOf("task");
    const JobSpec job{.kind = "sparse", .inputs = {task}, .label = "street"};
    ORBWEAVE_CHECK((*journal)->SaveJob({.spec = job, .error = "e"}).ok());
    ORBWEAVE_CHECK((*journal)->SaveStart({1, task, job.Id(), "align", 0, "w", 0}).ok());
    ORBWEAVE_CHECK((*journal)->SaveStart({2, task, job.Id(), "align", 1, "w", 1}).ok());
    ORBWEAVE_CHECK((*journal)->SaveResult(1, task, {.outputs = {task}}).ok());
  }
  return AfterSql(path, "");
}

}  // namespace

void AddFileSeeds(const std::string& folder, Seeds& seeds) {
  seeds["colmap_model"] = {ModelFiles(folder)};
  // The latter two have counts whose products wrap to the size of their empty blobs.
  seeds["colmap_database"] = {
      DatabaseFile(folder, ""),
      DatabaseFile(folder, "UPDATE keypoints SET rows = 1 << 62, cols = 4, data = x''"),
      DatabaseFile(folder, "UPDATE two_view_geometries SET rows = 1 << 61, data = x''")};
  seeds["journal"] = {JournalFile(folder)};
}

}  // namespace orbweave
