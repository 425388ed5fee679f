// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/io/byte_stream.h"
#include "core/io/cubes/cube_face_image.h"
#include "core/io/cubes/export_cube_faces.h"
#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

absl::StatusOr<std::string> Nothing(const ImageRecord& /*record*/) { return std::string(); }

Rigid3 TakePose(ByteReader& in) {
  const double w = in.Take<double>();
  const double x = in.Take<double>();
  const double y = in.Take<double>();
  const double z = in.Take<double>();
  Rigid3 pose = {Eigen::Quaterniond(w, x, y, z), Vector3d::Zero()};
  for (double& part : pose.translation) part = in.Take<double>();
  return pose;
}

struct Pinhole {
  uint64_t width_px = 0;
  double f = 0.0;
  double c = 0.0;

  [[nodiscard]] Vector2d Project(const Vector3d& point) const {
    return Vector2d::Constant(c) + f * point.head<2>() / point.z();
  }
};

struct Image {
  Rigid3 cam_from_world{};
  uint32_t camera = 0;
  std::string name{};
  std::vector<std::pair<Vector2d, uint64_t>> points{};
};

struct Point {
  Vector3d position{};
  double error_px = 0.0;
  std::vector<std::pair<uint32_t, uint32_t>> track{};
};

/// A model as COLMAP's reconstruction_io_binary.cc reads it.
struct Model {
  std::map<uint32_t, Pinhole> cameras{};
  std::map<uint32_t, Image> images{};
  std::map<uint64_t, Point> points{};
  std::map<uint32_t, Rigid3> camera_from_rig{};                      ///< by camera
  std::map<uint32_t, std::pair<uint32_t, Rigid3>> rig_from_world{};  ///< by image: its camera
};

void ReadCameras(const std::string& bytes, Model& model) {
  ByteReader in(bytes);
  for (auto left = in.Take<uint64_t>(); left > 0; --left) {
    Pinhole& camera = model.cameras[in.Take<uint32_t>()];
    EXPECT_EQ(in.Take<int32_t>(), 1);  // PINHOLE
    camera.width_px = in.Take<uint64_t>();
    EXPECT_EQ(in.Take<uint64_t>(), camera.width_px);
    camera.f = in.Take<double>();
    EXPECT_EQ(in.Take<double>(), camera.f);
    camera.c = in.Take<double>();
    EXPECT_EQ(in.Take<double>(), camera.c);
  }
  EXPECT_TRUE(in.ok() && in.AtEnd());
}

void ReadImages(const std::string& bytes, Model& model) {
  ByteReader in(bytes);
  for (auto left = in.Take<uint64_t>(); left > 0; --left) {
    Image& image = model.images[in.Take<uint32_t>()];
    image.cam_from_world = TakePose(in);
    image.camera = in.Take<uint32_t>();
    image.name = in.TakeText();
    image.points.resize(in.TakeCount(24));
    for (auto& [pixel, point] : image.points) {
      for (double& part : pixel) part = in.Take<double>();
      point = in.Take<uint64_t>();
    }
  }
  EXPECT_TRUE(in.ok() && in.AtEnd());
}

void ReadPoints(const std::string& bytes, Model& model) {
  ByteReader in(bytes);
  for (auto left = in.Take<uint64_t>(); left > 0; --left) {
    Point& point = model.points[in.Take<uint64_t>()];
    for (double& part : point.position) part = in.Take<double>();
    for (int i = 0; i < 3; ++i) (void)in.Take<uint8_t>();
    point.error_px = in.Take<double>();
    point.track.resize(in.TakeCount(8));
    for (auto& [image, index] : point.track) {
      image = in.Take<uint32_t>();
      index = in.Take<uint32_t>();
    }
  }
  EXPECT_TRUE(in.ok() && in.AtEnd());
}

void ReadRigsAndFrames(const std::string& rigs, const std::string& frames, Model& model) {
  ByteReader in(rigs);
  for (auto left = in.Take<uint64_t>(); left > 0; --left) {
    (void)in.Take<uint32_t>();  // rig
    const auto sensors = in.Take<uint32_t>();
    EXPECT_EQ(sensors, 6U);
    for (uint32_t sensor = 0; sensor < sensors; ++sensor) {
      EXPECT_EQ(in.Take<int32_t>(), 0);  // a camera
      Rigid3& pose = model.camera_from_rig[in.Take<uint32_t>()];
      if (sensor == 0) continue;
      EXPECT_EQ(in.Take<uint8_t>(), 1);  // has a pose
      pose = TakePose(in);
    }
  }
  EXPECT_TRUE(in.ok() && in.AtEnd());
  ByteReader more(frames);
  for (auto left = more.Take<uint64_t>(); left > 0; --left) {
    (void)more.Take<uint32_t>();  // frame
    (void)more.Take<uint32_t>();  // rig
    const Rigid3 pose = TakePose(more);
    for (auto data = more.Take<uint32_t>(); data > 0; --data) {
      EXPECT_EQ(more.Take<int32_t>(), 0);
      const auto camera = more.Take<uint32_t>();
      model.rig_from_world[static_cast<uint32_t>(more.Take<uint64_t>())] = {camera, pose};
    }
  }
  EXPECT_TRUE(more.ok() && more.AtEnd());
}

Model ReadModel(const std::string& sparse) {
  Model model;
  ReadCameras(ReadFile(sparse + "/cameras.bin").value(), model);
  ReadImages(ReadFile(sparse + "/images.bin").value(), model);
  ReadPoints(ReadFile(sparse + "/points3D.bin").value(), model);
  ReadRigsAndFrames(
      ReadFile(sparse + "/rigs.bin").value(), ReadFile(sparse + "/frames.bin").value(), model);
  return model;
}

/// The small scene as `folder` has it after an export of its poses and points.
SmallScene ExportSmallScene(const TemporaryFolder& folder) {
  SmallScene scene = MakeSmallScene(12, 300);
  const auto counts =
      ExportCubeFaces(folder.path(), scene.reconstruction, scene.manifest, {}, Nothing, Nothing);
  EXPECT_TRUE(counts.ok()) << counts.status();
  EXPECT_EQ(counts->panoramas, scene.reconstruction.images.size());
  EXPECT_EQ(counts->without_pixels, counts->panoramas);
  return scene;
}

TEST(CubeColmapWriter, PutsObservationsWherePinholesSeeThePoints) {
  const TemporaryFolder folder;
  const SmallScene scene = ExportSmallScene(folder);
  const Model model = ReadModel(folder / "sparse/0");
  ASSERT_EQ(model.points.size(), scene.reconstruction.tracks.size());
  EXPECT_EQ(model.cameras.size(), 12U);  // panoramas of two sizes
  size_t observations = 0;
  for (const auto& [id, point] : model.points) {
    EXPECT_EQ(point.position, scene.reconstruction.tracks[id - 1].point_in_world);
    EXPECT_NEAR(point.error_px, 0.0, 1e-6);
    for (const auto& [image_id, index] : point.track) {
      const Image& image = model.images.at(image_id);
      const Pinhole& camera = model.cameras.at(image.camera);
      const Vector3d in_face = image.cam_from_world * point.position;
      EXPECT_GT(in_face.z(), 0.0);
      const auto& [pixel, seen] = image.points.at(index);
      EXPECT_EQ(seen, id);
      EXPECT_LT((camera.Project(in_face) - pixel).norm(), 0.01);
      EXPECT_GE(pixel.minCoeff(), 0.0);
      EXPECT_LE(pixel.maxCoeff(), static_cast<double>(camera.width_px));
      ++observations;
    }
  }
  EXPECT_EQ(observations, scene.reconstruction.NumObservations());
}

TEST(CubeColmapWriter, GivesFacesTheCentreOfTheirPanoramaAndOneRig) {
  const TemporaryFolder folder;
  const SmallScene scene = ExportSmallScene(folder);
  const Model model = ReadModel(folder / "sparse/0");
  ASSERT_EQ(model.images.size(), 6 * scene.reconstruction.images.size());
  for (const auto& [id, image] : model.images) {
    const ImageId panorama((id - 1) / 6);
    const Rigid3& cam_from_world = scene.reconstruction.images.at(panorama).cam_from_world;
    EXPECT_LT((image.cam_from_world.Centre() - cam_from_world.Centre()).norm(), 1e-9);
    const auto& [camera, rig_from_world] = model.rig_from_world.at(id);
    EXPECT_EQ(camera, image.camera);
    const Rigid3 by_rig = model.camera_from_rig.at(camera) * rig_from_world;
    EXPECT_LT(
        (by_rig.rotation.toRotationMatrix() - image.cam_from_world.rotation.toRotationMatrix())
            .norm(),
        1e-12);
    EXPECT_LT((by_rig.translation - image.cam_from_world.translation).norm(), 1e-9);
  }
  EXPECT_EQ(model.images.at(1).name, "front/street/img0.jpg");
  EXPECT_EQ(model.images.at(6).name, "down/street/img0.jpg");
  EXPECT_EQ(model.cameras.at(1).width_px, 652U);  // 2048 / pi
}

TEST(WriteCubeTransforms, LooksAlongMinusZWithYUp) {
  const TemporaryFolder folder;
  ExportSmallScene(folder);
  const Model model = ReadModel(folder / "sparse/0");
  const auto json = nlohmann::json::parse(ReadFile(folder / "transforms.json").value());
  EXPECT_EQ(json["camera_model"], "OPENCV");
  ASSERT_EQ(json["frames"].size(), model.images.size());
  size_t place = 0;
  for (const auto& [id, image] : model.images) {
    const auto& frame = json["frames"][place++];
    EXPECT_EQ(frame["file_path"], "images/" + image.name);
    Eigen::Matrix4d world_from_camera;
    for (int i = 0; i < 16; ++i)
      world_from_camera(i / 4, i % 4) = frame["transform_matrix"][i / 4][i % 4];
    for (const auto& [pixel, point] : image.points) {
      const Vector3d in_camera =
          (world_from_camera.inverse() * model.points.at(point).position.homogeneous()).head<3>();
      EXPECT_LT(in_camera.z(), 0.0);
      const Vector2d seen(
          frame["cx"].get<double>() - frame["fl_x"].get<double>() * in_camera.x() / in_camera.z(),
          frame["cy"].get<double>() + frame["fl_y"].get<double>() * in_camera.y() / in_camera.z());
      EXPECT_LT((seen - pixel).norm(), 0.01);
    }
  }
}

std::string TakeString(ByteReader& in) {
  std::string text(in.TakeCount(1), ' ');
  for (char& letter : text) letter = in.Take<char>();
  return text;
}

Eigen::Matrix3d TakeMatrix(ByteReader& in) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = in.Take<double>();
  return matrix;
}

Vector3d TakeVector(ByteReader& in) {
  const double x = in.Take<double>();
  const double y = in.Take<double>();
  return {x, y, in.Take<double>()};
}

TEST(CubeMvsWriter, HasTheLayoutOfInterfaceArchives) {
  const TemporaryFolder folder;
  const SmallScene scene = ExportSmallScene(folder);
  const Model model = ReadModel(folder / "sparse/0");
  const std::string bytes = ReadFile(folder / "scene.mvs").value();
  ASSERT_EQ(bytes.substr(0, 4), "MVSI");
  ByteReader in(bytes);
  for (int i = 0; i < 4; ++i) (void)in.Take<char>();
  EXPECT_EQ(in.Take<uint32_t>(), 5U);
  EXPECT_EQ(in.Take<uint32_t>(), 0U);
  struct Camera {
    Eigen::Matrix3d K, R;
    Vector3d C;
  };
  struct Platform {
    std::vector<Camera> cameras{};
    std::vector<std::pair<Eigen::Matrix3d, Vector3d>> poses{};
  };
  std::vector<Platform> platforms(in.TakeCount(8));
  EXPECT_EQ(platforms.size(), 2U);
  for (Platform& platform : platforms) {
    (void)TakeString(in);
    for (auto left = in.Take<uint64_t>(); left > 0; --left) {
      (void)TakeString(in);
      EXPECT_EQ(TakeString(in), "");  // band
      const auto width = in.Take<uint32_t>();
      EXPECT_EQ(in.Take<uint32_t>(), width);
      Camera camera{TakeMatrix(in), TakeMatrix(in), Vector3d::Zero()};
      camera.C = TakeVector(in);
      EXPECT_EQ(camera.K(0, 2), 0.5 * (width - 1.0));
      platform.cameras.push_back(camera);
    }
    for (auto left = in.Take<uint64_t>(); left > 0; --left) {
      const Eigen::Matrix3d R = TakeMatrix(in);
      platform.poses.emplace_back(R, TakeVector(in));
    }
  }
  struct View {
    std::string name{};
    Eigen::Matrix3d K, R;
    Vector3d C;
  };
  std::vector<View> views(in.TakeCount(8));
  ASSERT_EQ(views.size(), model.images.size());
  for (size_t i = 0; i < views.size(); ++i) {
    const std::string name = TakeString(in);
    EXPECT_EQ(TakeString(in), "");  // mask
    const Platform& platform = platforms.at(in.Take<uint32_t>());
    const Camera& camera = platform.cameras.at(in.Take<uint32_t>());
    const auto& [R, C] = platform.poses.at(in.Take<uint32_t>());
    EXPECT_EQ(in.Take<uint32_t>(), i);
    views[i] = {name, camera.K, camera.R * R, R.transpose() * camera.C + C};
  }
  const size_t points = in.TakeCount(20);
  ASSERT_EQ(points, scene.reconstruction.tracks.size());
  for (size_t i = 0; i < points; ++i) {
    Vector3d X;
    for (double& part : X) part = static_cast<double>(in.Take<float>());
    const Point& point = model.points.at(i + 1);
    EXPECT_LT((X - point.position).norm(), 1e-4);
    size_t count = in.TakeCount(8);
    EXPECT_EQ(count, point.track.size());
    for (int64_t last = -1; count > 0; --count) {
      const auto view = in.Take<uint32_t>();
      EXPECT_EQ(in.Take<float>(), 0.0F);
      EXPECT_LT(last, static_cast<int64_t>(view));
      last = view;
      const View& seen = views.at(view);
      const Vector3d projected = seen.K * (seen.R * (point.position - seen.C));
      bool found = false;  // COLMAP's pixels are half a pixel larger
      for (const auto& [image_id, index] : point.track) {
        const Image& image = model.images.at(image_id);
        if ("images/" + image.name != seen.name) continue;
        const Vector2d pixel = projected.hnormalized() + Vector2d::Constant(0.5);
        found = (pixel - image.points.at(index).first).norm() < 0.01;
      }
      EXPECT_TRUE(found);
    }
  }
  EXPECT_EQ(in.Take<uint64_t>(), 0U);  // normals
  ASSERT_EQ(in.TakeCount(3), points);
  for (size_t i = 0; i < points; ++i) {
    EXPECT_EQ(in.Take<uint8_t>(), 30);  // blue first
    EXPECT_EQ(in.Take<uint8_t>(), 20);
    EXPECT_EQ(in.Take<uint8_t>(), scene.reconstruction.tracks[i].color.r);
  }
  for (int i = 0; i < 3; ++i) EXPECT_EQ(in.Take<uint64_t>(), 0U);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(in.Take<double>(), i % 5 == 0 ? 1.0 : 0.0);
  EXPECT_TRUE(in.ok() && in.AtEnd());
}

/// Waves about a slanted axis: a shift of a twentieth of a pixel shows.
double WavesAt(const Vector3d& bearing) {
  return 128.0 + 110.0 * std::sin(40.0 * bearing.dot(Vector3d(0.5, 0.7, -0.5)));
}

std::vector<uint8_t> PaintWaves(const EquirectangularCamera& camera) {
  std::vector<uint8_t> bytes;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column) {
      bytes.push_back(static_cast<uint8_t>(
          std::lround(WavesAt(camera.BearingFromPixel({column + 0.5, row + 0.5})))));
    }
  }
  return bytes;
}

TEST(ResampleFace, ShowsWhatThePanoramaShowsEverywhere) {
  constexpr EquirectangularCamera kCamera = {2048, 1024};
  constexpr PinholeFace kFace = {301};
  const std::vector<uint8_t> bytes = PaintWaves(kCamera);
  constexpr PinholeFace kFine = {700};  // not reduced: bilinear
  for (const PinholeFace pinhole : {kFace, kFine}) {
    for (int face = 0; face < kCubeFaces; ++face) {
      const auto pixels = ResampleFace({kCamera, 1, bytes}, face, pinhole);
      double worst = 0.0;
      for (int i = 0; i < pinhole.size_px * pinhole.size_px; ++i) {
        const Vector2d place(i % pinhole.size_px + 0.5, i / pinhole.size_px + 0.5);
        const Vector3d bearing = FaceFromCamera(face).transpose() * pinhole.BearingFromPixel(place);
        worst = std::max(worst, std::abs(pixels[static_cast<size_t>(i)] - WavesAt(bearing)));
      }
      EXPECT_LT(worst, 3.0) << face << " of " << pinhole.size_px;
    }
  }
}

TEST(ResampleFace, AveragesWhatItReduces) {
  constexpr EquirectangularCamera kCamera = {1024, 512};
  Random random(4);
  std::vector<uint8_t> bytes(1024 * 512);
  for (uint8_t& byte : bytes) byte = random.Index(2) == 0 ? 0 : 255;
  const auto pixels = ResampleFace({kCamera, 1, bytes}, 0, {32});  // a tenth
  double square = 0.0;
  for (const uint8_t pixel : pixels) square += (pixel - 127.5) * (pixel - 127.5);
  EXPECT_LT(std::sqrt(square / static_cast<double>(pixels.size())), 25.0);  // of 127.5
}

SmallScene OnePanorama(const EquirectangularCamera& camera, const std::string& name) {
  SmallScene scene;
  scene.manifest.images.push_back({.id = ImageId(0), .name = name, .camera = camera});
  scene.reconstruction.images[ImageId(0)] = {};
  return scene;
}

TEST(ExportCubeFaces, WritesImagesAndMasks) {
  const TemporaryFolder folder;
  constexpr EquirectangularCamera kCamera = {256, 128};
  SmallScene scene = OnePanorama(kCamera, "a/b.png");
  scene.manifest.images[0].mask = DigestOf("any");
  cv::Mat mask(64, 128, CV_8UC1, cv::Scalar(0));  // white on the right half: x > 0
  mask.colRange(64, 128).setTo(255);
  std::vector<uint8_t> png;
  cv::imencode(".png", mask, png);
  const auto counts = ExportCubeFaces(
      folder.path(),
      scene.reconstruction,
      scene.manifest,
      {.size_px = 50},
      [](const ImageRecord&) { return EncodedImage(256, 128, ".png"); },
      [&](const ImageRecord&) { return std::string(png.begin(), png.end()); });
  ASSERT_TRUE(counts.ok()) << counts.status();
  EXPECT_EQ(counts->panoramas, 1U);
  EXPECT_EQ(counts->without_pixels, 0U);
  for (const std::string face : {"front", "right", "back", "left", "up", "down"}) {
    const cv::Mat image = cv::imread(folder / ("images/" + face + "/a/b.png.jpg"));
    EXPECT_EQ(image.rows, 50) << face;
    EXPECT_EQ(image.cols, 50) << face;
    EXPECT_FALSE(cv::imread(folder / ("masks/" + face + "/a/b.png.jpg.png")).empty()) << face;
  }
  const cv::Mat front = cv::imread(folder / "masks/front/a/b.png.jpg.png", cv::IMREAD_GRAYSCALE);
  EXPECT_EQ(front.at<uint8_t>(25, 5), 255);
  EXPECT_EQ(front.at<uint8_t>(25, 45), 0);  // ignored
  const cv::Mat right = cv::imread(folder / "masks/right/a/b.png.jpg.png", cv::IMREAD_GRAYSCALE);
  EXPECT_EQ(cv::countNonZero(right), 0);
  const auto json = nlohmann::json::parse(ReadFile(folder / "transforms.json").value());
  EXPECT_EQ(json["frames"][0]["mask_path"], "masks/front/a/b.png.jpg.png");
}

TEST(ExportCubeFaces, WritesTheSameForAnyNumberOfThreads) {
  constexpr EquirectangularCamera kCamera = {256, 128};
  SmallScene scene;
  for (uint32_t i = 0; i < 5; ++i) {
    scene.manifest.images.push_back(
        {.id = ImageId(i), .name = std::to_string(i) + ".jpg", .camera = kCamera});
    scene.reconstruction.images[ImageId(i)] = {};
  }
  std::vector<std::string> bytes;
  for (const int threads : {1, 4}) {
    const TemporaryFolder folder;
    const auto pixels = [](const ImageRecord& record) {
      return EncodedImage(256, 128, ".jpg", record.id.value);
    };
    ASSERT_TRUE(ExportCubeFaces(folder.path(),
                                scene.reconstruction,
                                scene.manifest,
                                {.num_threads = threads},
                                pixels,
                                Nothing)
                    .ok());
    bytes.push_back(ReadFile(folder / "images/up/3.jpg").value());
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(ExportCubeFaces, LeavesLooseImagesOutAndWritesWhatIsAskedFor) {
  const TemporaryFolder folder;
  SmallScene scene = MakeSmallScene(6, 50);
  scene.reconstruction.images.at(ImageId(3)).loose = true;
  const CubeExportOptions options = {.nerfstudio = false, .openmvs = false};
  const auto counts = ExportCubeFaces(
      folder.path(), scene.reconstruction, scene.manifest, options, Nothing, Nothing);
  ASSERT_TRUE(counts.ok()) << counts.status();
  EXPECT_EQ(counts->panoramas, scene.reconstruction.images.size() - 1);
  const Model model = ReadModel(folder / "sparse/0");
  EXPECT_FALSE(model.images.contains(6 * 3 + 1));
  for (const auto& [id, point] : model.points) EXPECT_GE(point.track.size(), 2U);
  EXPECT_FALSE(std::filesystem::exists(folder / "transforms.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "scene.mvs"));
}

TEST(ExportCubeFaces, NamesTheImageThatIsBroken) {
  const TemporaryFolder folder;
  constexpr EquirectangularCamera kCamera = {256, 128};
  const auto status_of = [&](const std::string& name, const std::string& encoded) {
    const SmallScene scene = OnePanorama(kCamera, name);
    return ExportCubeFaces(
               folder.path(),
               scene.reconstruction,
               scene.manifest,
               {},
               [&](const ImageRecord&) { return encoded; },
               Nothing)
        .status();
  };
  EXPECT_EQ(status_of("a.jpg", EncodedImage(256, 128, ".jpg")), absl::OkStatus());
  const absl::Status size = status_of("a.jpg", EncodedImage(512, 256, ".jpg"));
  EXPECT_EQ(size.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(size.message().find("a.jpg"), std::string::npos) << size;
  EXPECT_NE(size.message().find("512 x 256"), std::string::npos) << size;
  for (const std::string extension : {".png", ".jpg"}) {
    const std::string whole = EncodedImage(256, 128, extension);
    const absl::Status status = status_of("a.jpg", whole.substr(0, whole.size() / 2));
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_NE(status.message().find("truncated"), std::string::npos) << status;
  }
  for (const std::string name : {"../a.jpg", "b/../../a.jpg", "/etc/a.jpg", ""}) {
    const absl::Status status = status_of(name, "");
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << name;
    EXPECT_NE(status.message().find("leads out of the folder"), std::string::npos) << status;
  }
}

}  // namespace
}  // namespace orbweave
