// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/colmap_database.h"

#include <gmock/gmock.h>

#include "core/io/byte_stream.h"
#include "core/io/colmap/colmap_pair_id.h"
#include "core/io/colmap/read_colmap_database.h"
#include "core/io/colmap/write_colmap_database.h"
#include "core/io/file.h"
#include "core/io/sqlite_connection.h"
#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Three images of two sizes with keypoints, descriptors, priors and two pairs.
struct SmallJob {
  ImageManifest manifest{};
  std::vector<Features> features{};
  std::vector<TwoViewGeometry> pairs{};
};

SmallJob MakeSmallJob() {
  SmallJob job;
  Random random(2);
  for (uint32_t i = 0; i < 3; ++i) {
    ImageRecord record;
    record.id = ImageId(i);
    record.name = "img" + std::to_string(i + 9) + ".jpg";
    record.camera = i == 1 ? EquirectangularCamera{1024, 512} : EquirectangularCamera{2048, 1024};
    job.manifest.images.push_back(record);
    Features features;
    features.camera = record.camera;
    for (int k = 0; k < 20; ++k) {
      features.keypoints.push_back({static_cast<float>(random.Uniform(0, 1000)),
                                    static_cast<float>(random.Uniform(0, 500)),
                                    static_cast<float>(random.Uniform(1, 9)),
                                    static_cast<float>(random.Uniform(-3, 3))});
      for (int d = 0; d < kDescriptorSize; ++d)
        features.descriptors.push_back(static_cast<uint8_t>(random.Index(256)));
    }
    job.features.push_back(features);
  }
  job.manifest.images[0].prior.geodetic = GeodeticPosition{47.61, -122.32, 60.5};
  job.manifest.images[0].prior.horizontal_sigma_m = 0.5;
  job.manifest.images[0].prior.vertical_sigma_m = 1.5;
  job.manifest.images[2].prior.position_in_enu = Eigen::Vector3d(1, 2, 3);
  TwoViewGeometry general;
  general.pair = {ImageId(0), ImageId(1)};
  general.kind = TwoViewKind::kGeneral;
  general.b_from_a = {RotationFromVector({0.1, -0.7, 0.2}), Eigen::Vector3d(1, 2, -2).normalized()};
  general.inliers = {{0, 3}, {4, 5}, {19, 0}};
  TwoViewGeometry turned;
  turned.pair = {ImageId(1), ImageId(2)};
  turned.kind = TwoViewKind::kPureRotation;
  turned.b_from_a.rotation = RotationFromVector({0.0, 1.0, 0.0});
  turned.inliers = {{7, 8}};
  job.pairs = {general, turned};
  return job;
}

void ExpectSameJob(const ColmapDatabase& database, const SmallJob& job) {
  ASSERT_EQ(database.images.size(), 3U);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(database.images[i].name, job.manifest.images[i].name);
    EXPECT_EQ(database.images[i].database_id, i + 1);
    EXPECT_EQ(database.images[i].camera, job.manifest.images[i].camera);
    ASSERT_EQ(database.images[i].keypoints.size(), 20U);
    for (size_t k = 0; k < 20; ++k) {
      EXPECT_EQ(database.images[i].keypoints[k].x_px, job.features[i].keypoints[k].x_px);
      EXPECT_EQ(database.images[i].keypoints[k].y_px, job.features[i].keypoints[k].y_px);
      EXPECT_EQ(database.images[i].keypoints[k].scale_px, job.features[i].keypoints[k].scale_px);
      EXPECT_EQ(database.images[i].keypoints[k].orientation_rad,
                job.features[i].keypoints[k].orientation_rad);
    }
  }
  EXPECT_DOUBLE_EQ(database.images[0].prior.geodetic->longitude_deg, -122.32);
  EXPECT_DOUBLE_EQ(database.images[0].prior.horizontal_sigma_m, 0.5);
  EXPECT_DOUBLE_EQ(database.images[0].prior.vertical_sigma_m, 1.5);
  EXPECT_FALSE(database.images[1].prior.geodetic || database.images[1].prior.position_in_enu);
  EXPECT_EQ(*database.images[2].prior.position_in_enu, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(database.pairs.size(), job.pairs.size());
  for (size_t p = 0; p < job.pairs.size(); ++p) {
    EXPECT_EQ(database.pairs[p].pair, job.pairs[p].pair);
    EXPECT_EQ(database.pairs[p].kind, job.pairs[p].kind);
    EXPECT_EQ(database.pairs[p].inliers, job.pairs[p].inliers);
    EXPECT_LT(database.pairs[p].b_from_a.rotation.angularDistance(job.pairs[p].b_from_a.rotation),
              1e-7);
    EXPECT_LT((database.pairs[p].b_from_a.translation - job.pairs[p].b_from_a.translation).norm(),
              1e-12);
  }
  EXPECT_TRUE(database.matches_are_verified);
}

/// A written database to be altered by SQL.
class DatabaseFile : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(WriteColmapDatabase(path_, job_.manifest, job_.features, job_.pairs).ok());
  }
  void Execute(const std::string& sql) const {
    const auto connection = SqliteConnection::OpenToWrite(path_);
    ASSERT_TRUE(connection.ok());
    const absl::Status status = connection->Execute(sql);
    ASSERT_TRUE(status.ok()) << status;
  }
  [[nodiscard]] absl::Status ReadStatus() const { return ReadColmapDatabase(path_).status(); }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "database.db";
  SmallJob job_ = MakeSmallJob();
};

TEST(PairId, IsColmapsAndInvertible) {
  EXPECT_EQ(PairIdFromImageIds(1, 2), 2147483649U);
  for (const auto& [a, b] : {std::pair(0U, 1U),
                             std::pair(1U, 2U),
                             std::pair(5U, 2147483646U),
                             std::pair(2147483645U, 2147483646U)}) {
    EXPECT_EQ(ImageIdsFromPairId(PairIdFromImageIds(a, b)), std::pair(a, b));
  }
}

TEST_F(DatabaseFile, RoundTrips) {
  ExpectSameJob(ReadColmapDatabase(path_).value(), job_);
  ASSERT_TRUE(WriteColmapDatabase(
                  path_, job_.manifest, job_.features, job_.pairs, DatabaseCameraModel::kSphere)
                  .ok());
  ExpectSameJob(ReadColmapDatabase(path_).value(), job_);
}

TEST_F(DatabaseFile, IsWrittenTheSameTwice) {
  ASSERT_TRUE(
      WriteColmapDatabase(folder_ / "again.db", job_.manifest, job_.features, job_.pairs).ok());
  EXPECT_EQ(ReadFile(path_).value(), ReadFile(folder_ / "again.db").value());
}

TEST_F(DatabaseFile, ReadsTheTablesOf38) {
  Execute(
      "DROP TABLE rigs; DROP TABLE rig_sensors; DROP TABLE frames; DROP TABLE frame_data; DROP "
      "TABLE pose_priors;");
  for (ImageRecord& image : job_.manifest.images) image.prior = {};
  const ColmapDatabase database = ReadColmapDatabase(path_).value();
  EXPECT_FALSE(database.images[0].prior.geodetic);
  EXPECT_EQ(database.pairs.size(), 2U);
}

TEST_F(DatabaseFile, ReadsThePriorsOf39And311) {
  Execute(
      "CREATE TABLE old (image_id INTEGER PRIMARY KEY NOT NULL, position BLOB, coordinate_system "
      "INTEGER NOT NULL);"
      "INSERT INTO old SELECT corr_data_id, position, coordinate_system FROM pose_priors;"
      "DROP TABLE pose_priors; ALTER TABLE old RENAME TO pose_priors;");
  ColmapDatabase database = ReadColmapDatabase(path_).value();
  EXPECT_DOUBLE_EQ(database.images[0].prior.geodetic->latitude_deg, 47.61);
  EXPECT_FALSE(database.images[0].prior_sigma_known);
  Execute("ALTER TABLE pose_priors ADD COLUMN position_covariance BLOB DEFAULT NULL");
  database = ReadColmapDatabase(path_).value();
  EXPECT_EQ(*database.images[2].prior.position_in_enu, Eigen::Vector3d(1, 2, 3));
}

TEST_F(DatabaseFile, NumbersImagesInNaturalOrder) {
  // Image 1 becomes the last by name: its pairs turn round.
  Execute("UPDATE images SET name = 'img100.jpg' WHERE image_id = 1");
  const ColmapDatabase database = ReadColmapDatabase(path_).value();
  EXPECT_EQ(database.images[2].database_id, 1U);
  ASSERT_EQ(database.pairs.size(), 2U);
  EXPECT_EQ(database.pairs[1].pair, (ImagePair{ImageId(0), ImageId(2)}));
  EXPECT_THAT(database.pairs[1].inliers,
              ElementsAre(FeatureMatch{0, 19}, FeatureMatch{3, 0}, FeatureMatch{5, 4}));
  const Rigid3 expected = job_.pairs[0].b_from_a.Inverse();
  EXPECT_LT(database.pairs[1].b_from_a.rotation.angularDistance(expected.rotation), 1e-7);
  EXPECT_LT((database.pairs[1].b_from_a.translation - expected.translation).norm(), 1e-12);
}

TEST_F(DatabaseFile, ReadsKeypointsOfTwoAndSixColumns) {
  const float scale = 2.5F;
  const float angle = 0.7F;
  ByteWriter two;
  ByteWriter six;
  for (int i = 0; i < 20; ++i) {
    two.Put(static_cast<float>(i)).Put(1.0F);
    six.Put(static_cast<float>(i)).Put(2.0F);
    six.Put(scale * std::cos(angle))
        .Put(-scale * std::sin(angle))
        .Put(scale * std::sin(angle))
        .Put(scale * std::cos(angle));
  }
  const auto connection = SqliteConnection::OpenToWrite(path_);
  SqliteStatement update =
      connection->Prepare("UPDATE keypoints SET cols = ?, data = ? WHERE image_id = ?").value();
  const std::string blobs[2] = {two.Take(), six.Take()};
  for (const int columns : {2, 6}) {
    update.Bind(1, int64_t{columns});
    update.BindBlob(2, blobs[columns == 2 ? 0 : 1]);
    update.Bind(3, int64_t{columns == 2 ? 1 : 2});
    ASSERT_TRUE(update.Run().ok());
  }
  const ColmapDatabase database = ReadColmapDatabase(path_).value();
  EXPECT_EQ(database.images[0].keypoints[7].x_px, 7.0F);
  EXPECT_EQ(database.images[0].keypoints[7].scale_px, 1.0F);
  EXPECT_NEAR(database.images[1].keypoints[7].scale_px, scale, 1e-6);
  EXPECT_NEAR(database.images[1].keypoints[7].orientation_rad, angle, 1e-6);
}

TEST_F(DatabaseFile, FallsBackOnRawMatches) {
  Execute("DELETE FROM two_view_geometries");
  const ColmapDatabase database = ReadColmapDatabase(path_).value();
  EXPECT_FALSE(database.matches_are_verified);
  ASSERT_EQ(database.pairs.size(), 2U);
  EXPECT_EQ(database.pairs[0].inliers, job_.pairs[0].inliers);
  EXPECT_EQ(database.pairs[0].kind, TwoViewKind::kNone);
}

TEST_F(DatabaseFile, DoesNotTakeTheDefaultIdentityForAPose) {
  Execute("UPDATE two_view_geometries SET tvec = zeroblob(24)");
  const ColmapDatabase database = ReadColmapDatabase(path_).value();
  EXPECT_EQ(database.pairs[0].kind, TwoViewKind::kNone);
  EXPECT_EQ(database.pairs[0].inliers.size(), 3U);
}

TEST_F(DatabaseFile, NamesThePinholeCamera) {
  Execute("UPDATE cameras SET model = 1 WHERE camera_id = 2");
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(ReadStatus().message(), HasSubstr("camera 2 is PINHOLE; only panoramas"));
}

TEST_F(DatabaseFile, SaysWhatIsMissing) {
  Execute("DELETE FROM two_view_geometries; DELETE FROM matches;");
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(ReadStatus().message(), HasSubstr("no matches"));
  Execute("DELETE FROM images");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("no images"));
  EXPECT_EQ(ReadColmapDatabase(folder_ / "other.db").status().code(), absl::StatusCode::kNotFound);
}

TEST_F(DatabaseFile, NamesDamagedRows) {
  Execute(
      "UPDATE two_view_geometries SET data = x'00000000ffffff7f0000000000000000000000000000000000' "
      "WHERE rows = 3");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("img9.jpg and img10.jpg"));
  Execute("UPDATE keypoints SET rows = 21 WHERE image_id = 3");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("the keypoints row of img11.jpg"));
  Execute("UPDATE keypoints SET rows = 0, data = NULL");
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kInvalidArgument);
}

/// Lets go of the constraints of a table, as a database that somebody made need not have them.
std::string WithoutConstraints(const std::string& table) {
  return "CREATE TABLE loose AS SELECT * FROM " + table + "; DROP TABLE " + table +
         "; ALTER TABLE loose RENAME TO " + table + ";";
}

TEST_F(DatabaseFile, RefusesImagesOfOneNameOrNumber) {
  Execute("DROP INDEX index_name;" + WithoutConstraints("images"));
  Execute("UPDATE images SET name = 'img9.jpg' WHERE image_id = 2");
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(ReadStatus().message(), HasSubstr("are both called img9.jpg"));
  Execute("UPDATE images SET name = 'img10.jpg', image_id = 1 WHERE image_id = 2");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("image 1 is there twice"));
  Execute("UPDATE images SET image_id = -1 WHERE name = 'img10.jpg'");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("an image has the number -1"));
  Execute("UPDATE images SET image_id = 4294967298 WHERE name = 'img10.jpg'");  // 2 in 32 bits
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(DatabaseFile, RefusesNamesThatAreNone) {
  Execute("UPDATE images SET name = '' WHERE image_id = 2");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("image 2 has no name"));
  Execute("UPDATE images SET name = hex(zeroblob(50000)) WHERE image_id = 2");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("the name of image 2 has 100000 bytes"));
}

TEST_F(DatabaseFile, RefusesAPairThatIsThereTwice) {
  Execute(WithoutConstraints("two_view_geometries"));
  EXPECT_TRUE(ReadStatus().ok());
  Execute("INSERT INTO two_view_geometries SELECT * FROM two_view_geometries WHERE rows = 3");
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(ReadStatus().message(),
              HasSubstr("two_view_geometries: the pair of img9.jpg and img10.jpg is there twice"));
}

TEST_F(DatabaseFile, RefusesAPairThatIsThereInBothDirections) {
  const std::string turned = std::to_string(2147483647LL * 2 + 1);
  Execute("INSERT INTO two_view_geometries(pair_id, rows, cols, data, config) SELECT " + turned +
          ", 0, 2, x'', 2 FROM two_view_geometries LIMIT 1");
  Execute("UPDATE two_view_geometries SET rows = 1, data = zeroblob(8) WHERE rows = 0");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("is there twice"));
}

TEST_F(DatabaseFile, RefusesPairNumbersThatNameNoImages) {
  Execute("UPDATE two_view_geometries SET pair_id = -pair_id WHERE rows = 3");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("the pair id -2147483649 names no two images"));
  // 2^32 + 1 for the first image: 1 in 32 bits.
  Execute("UPDATE two_view_geometries SET pair_id = 2147483647 * 4294967297 + 2 WHERE rows = 3");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("names no two images"));
}

TEST_F(DatabaseFile, RefusesKeypointsOutsideOfTheirImage) {
  ByteWriter far;
  for (int i = 0; i < 20; ++i) far.Put(i == 7 ? 3e38F : 10.0F).Put(static_cast<float>(i));
  const std::string blob = far.Take();
  const auto connection = SqliteConnection::OpenToWrite(path_);
  SqliteStatement update =
      connection->Prepare("UPDATE keypoints SET cols = 2, data = ? WHERE image_id = 2").value();
  update.BindBlob(1, blob);
  ASSERT_TRUE(update.Run().ok());
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(ReadStatus().message(), HasSubstr("keypoint 7 of img10.jpg is at (3e+38, 7)"));
  EXPECT_THAT(ReadStatus().message(), HasSubstr("1024x512"));
}

TEST_F(DatabaseFile, RefusesKeypointsThatAreAllAtOnePlace) {
  Execute("UPDATE keypoints SET cols = 2, data = zeroblob(160) WHERE image_id = 3");
  EXPECT_THAT(ReadStatus().message(),
              HasSubstr("the 20 keypoints of img11.jpg are all at one place"));
}

TEST_F(DatabaseFile, RefusesKeypointsThatAreThereTwice) {
  Execute(WithoutConstraints("keypoints"));
  Execute("INSERT INTO keypoints SELECT * FROM keypoints");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("the keypoints of img"));
}

/// Three doubles as a blob in SQL.
std::string PositionBlob(double x, double y, double z) {
  ByteWriter out;
  out.Put(x).Put(y).Put(z);
  const std::string bytes = out.Take();
  std::string text = "x'";
  for (const char c : bytes) {
    for (const int nibble : {static_cast<uint8_t>(c) >> 4, c & 15})
      text += "0123456789abcdef"[nibble];
  }
  return text + "'";
}

TEST_F(DatabaseFile, LeavesOutPriorsThatCannotBeAndSaysSo) {
  const auto read = [&](const std::string& position, int system) {
    Execute("UPDATE pose_priors SET position = " + position +
            ", coordinate_system = " + std::to_string(system) + ", position_covariance = NULL");
    return ReadColmapDatabase(path_).value();
  };
  for (const auto& [position, system] : {std::pair(PositionBlob(0, 0, 0), 0),
                                         std::pair(PositionBlob(1e308, 0, 0), 0),
                                         std::pair(PositionBlob(1e308, 0, 0), 1),
                                         std::pair(PositionBlob(0, 0, 0), 1)}) {
    const ColmapDatabase database = read(position, system);
    for (const DatabaseImage& image : database.images)
      EXPECT_FALSE(image.prior.geodetic || image.prior.position_in_enu) << system;
    ASSERT_EQ(database.warnings.size(), 1U);
    EXPECT_THAT(database.warnings[0], HasSubstr("is not used (2 images: img9.jpg, img11.jpg)"));
  }
  const ColmapDatabase high = read(PositionBlob(47, 8, 1e308), 0);
  EXPECT_TRUE(high.images[0].prior.geodetic);
  EXPECT_FALSE(SourcesFromDatabase(high).images[0].metadata.altitude_known);
  EXPECT_THAT(SourcesFromDatabase(high).warnings, ElementsAre(HasSubstr("a height")));
}

TEST_F(DatabaseFile, LeavesOutCovariancesThatCannotBeAndSaysSo) {
  ByteWriter tiny;
  for (int i = 0; i < 9; ++i) tiny.Put(i % 4 == 0 ? 1e-300 : 0.0);
  const std::string blob = tiny.Take();
  const auto connection = SqliteConnection::OpenToWrite(path_);
  SqliteStatement update =
      connection->Prepare("UPDATE pose_priors SET position_covariance = ?").value();
  update.BindBlob(1, blob);
  ASSERT_TRUE(update.Run().ok());
  const ColmapDatabase database = ReadColmapDatabase(path_).value();
  EXPECT_FALSE(database.images[0].prior_sigma_known);
  EXPECT_THAT(database.warnings, ElementsAre(HasSubstr("a covariance that cannot be")));
}

TEST_F(DatabaseFile, NamesPriorsThatCannotBeRead) {
  const auto warnings = [&](const std::string& position, int system, const char* covariance) {
    Execute("UPDATE pose_priors SET position = " + position + ", coordinate_system = " +
            std::to_string(system) + ", position_covariance = " + covariance);
    const ColmapDatabase database = ReadColmapDatabase(path_).value();
    for (const DatabaseImage& image : database.images) EXPECT_FALSE(image.prior_sigma_known);
    return database.warnings;
  };
  EXPECT_THAT(warnings("x'0011'", 0, "NULL"),
              ElementsAre(HasSubstr("a position that is not three numbers is not used (2 images")));
  EXPECT_THAT(warnings(PositionBlob(NAN, 8, 0), 0, "NULL"), ElementsAre(HasSubstr("not three")));
  EXPECT_THAT(
      warnings(PositionBlob(47, 8, 0), 2, "NULL"),
      ElementsAre(HasSubstr("a coordinate system that is not known is not used (2 images")));
  EXPECT_THAT(warnings(PositionBlob(47, 8, 0), 0, "x'00'"),
              ElementsAre(HasSubstr("a covariance that is not nine numbers")));
  // What COLMAP writes where it knows nothing.
  EXPECT_THAT(warnings(PositionBlob(NAN, NAN, NAN), -1, "NULL"), IsEmpty());
  EXPECT_THAT(warnings("NULL", -1, "NULL"), IsEmpty());
}

TEST_F(DatabaseFile, RefusesCountsWhoseProductsWrapToTheSizeOfTheBlob) {
  Execute("UPDATE two_view_geometries SET rows = 1 << 61, data = x''");
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kInvalidArgument);
  Execute("UPDATE keypoints SET rows = 1 << 62, cols = 4, data = x''");
  EXPECT_THAT(ReadStatus().message(), HasSubstr("the keypoints row"));
}

TEST_F(DatabaseFile, RefusesWhatIsNoDatabase) {
  const std::string intact = ReadFile(path_).value();
  folder_.Write("database.db",
                "this is a text file that is longer than a header, honestly it is, by several "
                "words and more");
  EXPECT_EQ(ReadStatus().code(), absl::StatusCode::kInvalidArgument);
  int refused = 0;
  for (size_t size = 0; size < intact.size(); size += 3000) {
    folder_.Write("database.db", intact.substr(0, size));
    // Pages at the end may hold what is not read (descriptors): refused, or unchanged.
    const absl::StatusOr<ColmapDatabase> database = ReadColmapDatabase(path_);
    if (database.ok()) ExpectSameJob(*database, job_);
    refused += database.ok() ? 0 : 1;
  }
  EXPECT_GT(refused, 10);
}

TEST_F(DatabaseFile, BecomesSourcesInTheSameOrder) {
  const ImageSources sources = SourcesFromDatabase(ReadColmapDatabase(path_).value());
  ASSERT_EQ(sources.images.size(), 3U);
  EXPECT_EQ(sources.images[1].metadata.width_px, 1024);
  EXPECT_DOUBLE_EQ(sources.images[0].metadata.position->altitude_m, 60.5);
  EXPECT_EQ(*sources.images[0].position_sigma_m, Eigen::Vector2d(0.5, 1.5));
  EXPECT_EQ(*sources.images[2].position_in_local, Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace orbweave
