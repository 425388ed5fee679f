// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/scan_image_folder.h"

#include <gmock/gmock.h>

#include "tests/core/io/io_test_support.h"
#include "tests/core/io/tagged_image.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> Names(const ImageSources& sources) {
  std::vector<std::string> names;
  for (const SourceImage& image : sources.images) names.push_back(image.name);
  return names;
}

/// Each with pixels of its own.
void WriteImages(const TemporaryFolder& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    folder.Write(name, EncodedImage(64, 32, ".jpg", DigestOf(name).ToSeed()));
}

TEST(ScanImageFolder, ListsImagesBelowInNaturalOrder) {
  const TemporaryFolder folder;
  folder.Write("img10.jpg", EncodedImage(64, 32, ".jpg", 1));
  folder.Write("img2.JPG", EncodedImage(64, 32, ".jpg", 2));
  folder.Write("b/x.png", EncodedImage(32, 16, ".png"));
  folder.Write("notes.txt", "no image");
  folder.Write("._img2.jpg", "left by a Mac");
  std::filesystem::create_symlink(folder / "img10.jpg", folder / "img11.jpg");
  std::filesystem::create_directory_symlink(folder.path(), folder / "loop");
  const ImageSources sources =
      ScanImageFolder({.image_folder = folder.path()}, {.num_threads = 2}).value();
  EXPECT_THAT(Names(sources), ElementsAre("b/x.png", "img2.JPG", "img10.jpg", "img11.jpg"));
  EXPECT_EQ(sources.images[0].metadata.width_px, 32);
  EXPECT_EQ(sources.images[2].content, sources.images[3].content);
  EXPECT_NE(sources.images[1].content, sources.images[2].content);
  EXPECT_EQ(sources.images[1].content, DigestOf(EncodedImage(64, 32, ".jpg", 2)));
  for (const SourceImage& image : sources.images) EXPECT_EQ(image.problem, "") << image.name;
}

TEST(ScanImageFolder, SaysWhatIsWrongWithEachFile) {
  const TemporaryFolder folder;
  const std::string whole = EncodedImage(64, 32, ".jpg");
  folder.Write("a_text.jpg", "Dear diary, today I was renamed.\n");
  folder.Write("b_short.jpg", whole.substr(0, whole.size() / 2));
  folder.Write("c_empty.png", "");
  folder.Write("d_noise.png", std::string("\x01\x02\x03\x00\x05", 5));
  std::filesystem::create_symlink("nowhere.jpg", folder / "e_dangling.jpg");
  std::filesystem::create_directories(folder / "f_folder.jpg");
  folder.Write("g_good.jpg", whole);
  const ImageSources sources = ScanImageFolder({.image_folder = folder.path()}, {}).value();
  ASSERT_THAT(Names(sources),
              ElementsAre("a_text.jpg",
                          "b_short.jpg",
                          "c_empty.png",
                          "d_noise.png",
                          "e_dangling.jpg",
                          "g_good.jpg"));
  EXPECT_THAT(sources.images[0].problem, HasSubstr("text file"));
  EXPECT_THAT(sources.images[1].problem, HasSubstr("truncated"));
  EXPECT_THAT(sources.images[2].problem, HasSubstr("empty"));
  EXPECT_THAT(sources.images[3].problem, HasSubstr("no image"));
  EXPECT_THAT(sources.images[4].problem, HasSubstr("no such file"));
  EXPECT_EQ(sources.images[5].problem, "");
}

TEST(ScanImageFolder, SaysWhichPositionsAreNotUsedAndWhy) {
  const TemporaryFolder folder;
  for (int i = 0; i < 5; ++i) {
    const std::string latitude = i == 1 ? "45/1 0/1 0/1" : "-95/1 0/1 0/1";
    folder.Write(std::to_string(i) + ".jpg",
                 Tagged(EncodedImage(64, 32, ".jpg"),
                        {{"Exif.GPSInfo.GPSLatitude", latitude},
                         {"Exif.GPSInfo.GPSLatitudeRef", "N"},
                         {"Exif.GPSInfo.GPSLongitude", "10/1 0/1 0/1"},
                         {"Exif.GPSInfo.GPSLongitudeRef", "E"}}));
  }
  const ImageSources sources = ScanImageFolder({.image_folder = folder.path()}, {}).value();
  EXPECT_TRUE(sources.images[1].metadata.position);
  const std::string problem = " (latitude -95, longitude 10 is nowhere on Earth), ";
  EXPECT_THAT(sources.warnings,
              ElementsAre("the EXIF position of 4 images is not used: 0.jpg" + problem + "2.jpg" +
                          problem + "3.jpg" + problem + "..."));
}

TEST(ScanImageFolder, SaysWhichOtherValuesAreNotUsed) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    folder.Write(std::to_string(i) + ".jpg",
                 Tagged(EncodedImage(64, 32, ".jpg"),
                        {{"Exif.GPSInfo.GPSImgDirectionRef", i == 1 ? "T" : "M"},
                         {"Exif.GPSInfo.GPSImgDirection", "90/1"}},
                        {{"Xmp.GPano.PoseRollDegrees", i == 1 ? "400" : "4"}}));
  }
  EXPECT_THAT(ScanImageFolder({.image_folder = folder.path()}, {}).value().warnings,
              ElementsAre("the magnetic heading of 2 images is not used: 0.jpg (90), 2.jpg (90)",
                          "the roll of 1 image is not used: 1.jpg (400)"));
}

TEST(ScanImageFolder, LeavesOutNamesAndBytesThatNoMessageTakes) {
  const TemporaryFolder folder;
  folder.Write("a.jpg", EncodedImage(64, 32, ".jpg", 1));
  folder.Write("b\xfc.jpg", EncodedImage(64, 32, ".jpg", 2));
  folder.Write("table.csv", "name,latitude,longitude\nb\xfc.jpg,47,8\na.jpg,47,8\n");
  const ImageSources sources =
      ScanImageFolder({.image_folder = folder.path(), .gnss_table = folder / "table.csv"}, {})
          .value();
  EXPECT_THAT(Names(sources), ElementsAre("a.jpg", "b\xef\xbf\xbd.jpg"));
  EXPECT_EQ(sources.images[0].problem, "");
  EXPECT_THAT(sources.images[1].problem, HasSubstr("not UTF-8"));
  EXPECT_THAT(sources.gnss_text, HasSubstr("\nb\xef\xbf\xbd.jpg,47,8\na.jpg,47,8\n"));
}

TEST(ReadGnssFile, SaysWhatToDoWithUtf16) {
  const TemporaryFolder folder;
  folder.Write("little.csv", std::string("\xff\xfen\0a\0", 6));
  folder.Write("big.csv", std::string("\xfe\xff\0n\0a", 6));
  folder.Write("unmarked.csv", std::string("n\0a\0m\0e\0", 8));
  for (const char* name : {"little.csv", "big.csv", "unmarked.csv"}) {
    ImageSources sources;
    const absl::Status status = ReadGnssFile(folder / name, sources);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << name;
    EXPECT_THAT(status.message(), HasSubstr("save it as UTF-8")) << name;
  }
}

TEST(ScanImageFolder, FindsMasksByEveryConvention) {
  const TemporaryFolder folder;
  WriteImages(folder, {"a.jpg", "sub/b.jpg", "c.jpg", "d.jpg"});
  folder.Write("masks/a.jpg.png", EncodedImage(64, 32, ".png"));
  folder.Write("masks/a.png", EncodedImage(16, 8, ".png"));
  folder.Write("masks/SUB/B.PNG", EncodedImage(32, 16, ".png"));
  folder.Write("masks/d.jpg", EncodedImage(64, 32, ".jpg"));
  const ImageSources sources =
      ScanImageFolder({.image_folder = folder.path(), .masks = folder / "masks"}, {}).value();
  ASSERT_THAT(Names(sources), ElementsAre("a.jpg", "c.jpg", "d.jpg", "sub/b.jpg"));
  EXPECT_EQ(sources.images[0].mask, DigestOf(EncodedImage(64, 32, ".png")));
  EXPECT_TRUE(sources.images[1].mask.IsZero());
  EXPECT_THAT(sources.images[2].mask_path, HasSubstr("masks/d.jpg"));
  EXPECT_EQ(sources.images[3].mask_width_px, 32);
  EXPECT_THAT(sources.warnings, ElementsAre("1 mask has no image: a.png"));
}

TEST(ScanImageFolder, TakesOneMaskForAllImages) {
  const TemporaryFolder folder;
  WriteImages(folder, {"a.jpg", "sub/b.jpg"});
  folder.Write("car.png", EncodedImage(32, 16, ".png"));  // among the images, but none of them
  const ImageSources sources =
      ScanImageFolder({.image_folder = folder.path(), .masks = folder / "sub/../car.png"}, {})
          .value();
  ASSERT_THAT(Names(sources), ElementsAre("a.jpg", "sub/b.jpg"));
  for (const SourceImage& image : sources.images) {
    EXPECT_EQ(image.mask, DigestOf(EncodedImage(32, 16, ".png"))) << image.name;
    EXPECT_EQ(image.mask_width_px, 32) << image.name;
    EXPECT_THAT(image.mask_path, HasSubstr("car.png")) << image.name;
  }
  EXPECT_THAT(sources.warnings, IsEmpty());
}

TEST(ScanImageFolder, TakesTheMaskOfAFolderForWhatHasNoneOfItsOwn) {
  const TemporaryFolder folder;
  WriteImages(folder, {"a.jpg", "Monday/b.jpg", "Monday/c.jpg", "Monday/late/d.jpg"});
  folder.Write("masks/monday.png", EncodedImage(32, 16, ".png"));
  folder.Write("masks/Monday/c.png", EncodedImage(16, 8, ".png"));
  folder.Write("masks/late.png", EncodedImage(8, 4, ".png"));  // of no folder
  const ImageSources sources =
      ScanImageFolder({.image_folder = folder.path(), .masks = folder / "masks"}, {}).value();
  ASSERT_THAT(Names(sources),
              ElementsAre("Monday/b.jpg", "Monday/c.jpg", "Monday/late/d.jpg", "a.jpg"));
  EXPECT_EQ(sources.images[0].mask_width_px, 32);
  EXPECT_EQ(sources.images[1].mask_width_px, 16);
  EXPECT_EQ(sources.images[2].mask_width_px, 32);
  EXPECT_TRUE(sources.images[3].mask.IsZero());
  EXPECT_THAT(sources.warnings, ElementsAre("1 mask has no image: late.png"));
}

TEST(ScanImageFolder, NamesWhatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_THAT(ScanImageFolder({.image_folder = folder.path()}, {}).status().message(),
              HasSubstr("no images in " + folder.path()));
  const absl::Status missing = ScanImageFolder({.image_folder = folder / "typo"}, {}).status();
  EXPECT_EQ(missing.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(missing.message(), HasSubstr("typo"));
  folder.Write("a.jpg", EncodedImage(64, 32, ".jpg"));
  EXPECT_EQ(ScanImageFolder({.image_folder = folder.path(), .gnss_table = folder / "gnss.csv"}, {})
                .status()
                .code(),
            absl::StatusCode::kNotFound);
  EXPECT_EQ(ScanImageFolder({.image_folder = folder.path(), .masks = folder / "masks"}, {})
                .status()
                .code(),
            absl::StatusCode::kNotFound);
  const absl::Status no_mask =
      ScanImageFolder({.image_folder = folder.path(), .masks = folder / "car.png"}, {}).status();
  EXPECT_EQ(no_mask.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(no_mask.message(), HasSubstr("there is no mask " + (folder / "car.png")));
}

TEST(ScanImageFolder, StopsWhenAsked) {
  const TemporaryFolder folder;
  folder.Write("a.jpg", EncodedImage(64, 32, ".jpg"));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(
      ScanImageFolder({.image_folder = folder.path()}, {.stop = stop.get_token()}).status().code(),
      absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
