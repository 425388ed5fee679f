// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Images of an object store, held against the same files in a folder.

#include "objects/object_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/core/io/io_test_support.h"
#include "tests/core/io/tagged_image.h"
#include "tests/support/fault_store.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using testing::FaultStore;
using testing::FaultStoreOptions;
using ::testing::HasSubstr;
using testing::StoreFault;

/// A folder and a store with the same files in it.
class ObjectPlaceTest : public ::testing::Test {
 protected:
  explicit ObjectPlaceTest(FaultStoreOptions options = {.page_keys = 3})
      : store_(std::move(options)) {
    WriteKeys(store_.keys().secret_key);
  }

  void WriteKeys(const std::string& secret) {
    folder_.Write("keys",
                  "aws_access_key_id = " + store_.keys().access_key +
                      "\naws_secret_access_key = " + secret + "\n");
    ::chmod((folder_ / "keys").c_str(), 0600);
  }
  void Write(const std::string& name, const std::string& bytes) {
    folder_.Write("street/" + name, bytes);
    store_.SetObject("street/" + name, bytes);
  }
  void WriteStreet() {
    Write("images/img10.jpg", EncodedImage(64, 32, ".jpg", 1));
    Write("images/img2.JPG", EncodedImage(64, 32, ".jpg", 2));
    Write("images/b/x y+ü.png", EncodedImage(32, 16, ".png"));
    Write("images/notes.txt", "no image");
    Write("images/._img2.jpg", "left by a Mac");
    Write("images/.hidden/img3.jpg", EncodedImage(64, 32, ".jpg", 3));
    Write("images/text.jpg", "Dear diary, today I was renamed.\n");
    Write("images/short.jpg", EncodedImage(64, 32, ".jpg", 4).substr(0, 300));
    Write("images/masks/img2.jpg.png", EncodedImage(64, 32, ".png", 5));
    Write("images/masks/unused.png", EncodedImage(64, 32, ".png", 6));
    Write("images/place.jpg",
          Tagged(EncodedImage(64, 32, ".jpg", 7),
                 {{"Exif.GPSInfo.GPSLatitude", "48/1 0/1 0/1"},
                  {"Exif.GPSInfo.GPSLatitudeRef", "N"},
                  {"Exif.GPSInfo.GPSLongitude", "11/1 0/1 0/1"},
                  {"Exif.GPSInfo.GPSLongitudeRef", "E"}}));
    Write("gnss.csv", "name,latitude,longitude\nimg2.JPG,48.0,11.0\n");
    store_.SetObject("street/images/", "");  // as consoles make folders
  }
  std::string Url(const std::string& name) { return store_.Url("street/" + name); }
  ScanRequest InStore() {
    return {.image_folder = Url("images"),
            .masks = Url("images/masks"),
            .gnss_table = Url("gnss.csv"),
            .store_keys = folder_ / "keys"};
  }
  ScanRequest InFolder() {
    return {.image_folder = folder_ / "street/images",
            .masks = folder_ / "street/images/masks",
            .gnss_table = folder_ / "street/gnss.csv"};
  }
  static absl::StatusOr<ImageSources> Scan(const ScanRequest& request,
                                           const StageContext& context = {}) {
    ORBWEAVE_ASSIGN_OR_RETURN(const ImagePlaces places, OpenImagePlaces(request));
    return ScanImagePlaces(places, request, context);
  }
  /// The place of the images, listed.
  std::unique_ptr<ObjectPlace> Listed() {
    auto place = *ObjectPlace::Open(Url("images"), folder_ / "keys");
    ORBWEAVE_CHECK(place->List("", {}).ok());
    return place;
  }

  const TemporaryFolder folder_;
  FaultStore store_;
};

/// All that a job takes over from a scan, but for where the files lie.
void ExpectSame(const ImageSources& a, const ImageSources& b) {
  ASSERT_EQ(a.images.size(), b.images.size());
  for (size_t i = 0; i < a.images.size(); ++i) {
    const SourceImage& one = a.images[i];
    const SourceImage& other = b.images[i];
    EXPECT_EQ(one.name, other.name);
    EXPECT_EQ(one.content, other.content) << one.name;
    EXPECT_EQ(one.size_bytes, other.size_bytes) << one.name;
    EXPECT_EQ(one.problem, other.problem) << one.name;
    EXPECT_EQ(one.metadata.width_px, other.metadata.width_px) << one.name;
    EXPECT_EQ(one.metadata.position.has_value(), other.metadata.position.has_value()) << one.name;
    EXPECT_EQ(one.mask, other.mask) << one.name;
    EXPECT_EQ(one.mask_width_px, other.mask_width_px) << one.name;
    EXPECT_EQ(one.mask_path.empty(), other.mask_path.empty()) << one.name;
  }
  EXPECT_EQ(a.gnss_text, b.gnss_text);
  EXPECT_EQ(a.gnss_name, b.gnss_name);
  EXPECT_EQ(a.warnings, b.warnings);
}

TEST_F(ObjectPlaceTest, ImagesMayLieBelowTheirMasks) {
  WriteStreet();
  ScanRequest in_store = InStore();
  in_store.masks = store_.Url("street");
  ScanRequest in_folder = InFolder();
  in_folder.masks = folder_ / "street";
  const absl::StatusOr<ImageSources> found = Scan(in_store);
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_FALSE(found->images.empty());
  ExpectSame(*found, *Scan(in_folder));
}

TEST_F(ObjectPlaceTest, OneObjectMayBeTheMaskOfAll) {
  WriteStreet();
  ScanRequest in_store = InStore();
  in_store.masks = store_.Url("street/images/masks/img2.jpg.png");
  ScanRequest in_folder = InFolder();
  in_folder.masks = folder_ / "street/images/masks/img2.jpg.png";
  const absl::StatusOr<ImageSources> found = Scan(in_store);
  ASSERT_TRUE(found.ok()) << found.status();
  for (const SourceImage& image : found->images) EXPECT_FALSE(image.mask.IsZero()) << image.name;
  ExpectSame(*found, *Scan(in_folder));
  in_store.masks = store_.Url("street/none.png");
  EXPECT_THAT(Scan(in_store).status().message(),
              HasSubstr("there is no mask s3://blobs/street/none.png"));
}

TEST_F(ObjectPlaceTest, IsScannedLikeAFolderWithTheSameFiles) {
  WriteStreet();
  const auto scanned = Scan(InStore());
  ASSERT_TRUE(scanned.ok()) << scanned.status();
  ExpectSame(*scanned, *Scan(InFolder()));
  std::vector<std::string> names;
  for (const SourceImage& image : scanned->images) names.push_back(image.name);
  EXPECT_THAT(
      names,
      ElementsAre("b/x y+ü.png", "img2.JPG", "img10.jpg", "place.jpg", "short.jpg", "text.jpg"));
  EXPECT_EQ(scanned->images[1].path, "s3://blobs/street/images/img2.JPG");
  EXPECT_EQ(scanned->images[1].mask_path, "s3://blobs/street/images/masks/img2.jpg.png");
  EXPECT_FALSE(scanned->images[1].mask.IsZero());
  EXPECT_TRUE(scanned->images[3].metadata.position.has_value());
  EXPECT_THAT(scanned->images[5].problem, HasSubstr("text file"));
}

class FaultyObjectPlaceTest : public ObjectPlaceTest {
 protected:
  FaultyObjectPlaceTest()
      : ObjectPlaceTest({.page_keys = 2, .slow_down_share = 0.2, .cut_share = 0.2}) {}
};

TEST_F(FaultyObjectPlaceTest, IsScannedLikeAFolderWhereTheStoreFailsNowAndThen) {
  WriteStreet();
  const auto scanned = Scan(InStore());
  ASSERT_TRUE(scanned.ok()) << scanned.status();
  ExpectSame(*scanned, *Scan(InFolder()));
  EXPECT_GT(store_.Faults(), 3U);
}

TEST_F(ObjectPlaceTest, TakesFoldersBesideIt) {
  WriteStreet();
  ScanRequest mixed = InStore();
  mixed.masks = InFolder().masks;
  mixed.gnss_table = InFolder().gnss_table;
  store_.RemoveObject("street/images/masks/img2.jpg.png");
  store_.RemoveObject("street/images/masks/unused.png");
  ExpectSame(*Scan(mixed), *Scan(InFolder()));
}

TEST_F(ObjectPlaceTest, NamesAnObjectThatWasChangedOrRemovedWhileTheyWereRead) {
  WriteStreet();
  const auto place = Listed();
  EXPECT_TRUE(place->Look("img2.JPG", {}).ok());
  store_.SetObject("street/images/img2.JPG", EncodedImage(64, 32, ".jpg", 9));
  const absl::Status changed = place->Look("img2.JPG", {}).status();
  EXPECT_TRUE(absl::IsDataLoss(changed)) << changed;
  EXPECT_THAT(std::string(changed.message()),
              HasSubstr("s3://blobs/street/images/img2.JPG was changed"));
  store_.RemoveObject("street/images/img2.JPG");
  const absl::Status removed = place->Look("img2.JPG", {}).status();
  EXPECT_TRUE(absl::IsNotFound(removed)) << removed;
  EXPECT_THAT(std::string(removed.message()),
              HasSubstr("s3://blobs/street/images/img2.JPG was removed"));
}

TEST_F(ObjectPlaceTest, AnErrorOfOneEndsTheScanWithItsName) {
  WriteStreet();
  ScanRequest request = InStore();
  const auto places = OpenImagePlaces(request);
  StageContext context;
  context.report = [&](const Progress& progress) {
    if (progress.unit == "objects" && progress.done > 6)
      store_.RemoveObject("street/images/img10.jpg");
  };
  const absl::Status status = ScanImagePlaces(*places, request, context).status();
  EXPECT_TRUE(absl::IsNotFound(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("img10.jpg was removed"));
}

TEST_F(ObjectPlaceTest, SaysWhatIsWrongWithTheAddressOrTheRights) {
  WriteStreet();
  const auto error = [&](const std::string& address) {
    return Scan({.image_folder = address, .store_keys = folder_ / "keys"}).status();
  };
  const absl::Status empty = error(Url("imagse"));
  EXPECT_TRUE(absl::IsNotFound(empty)) << empty;
  EXPECT_THAT(std::string(empty.message()), HasSubstr("no images in s3://blobs/street/imagse"));
  std::string other = Url("images");
  other.replace(other.find("blobs"), 5, "globs");
  const absl::Status bucket = error(other);
  EXPECT_TRUE(absl::IsFailedPrecondition(bucket)) << bucket;
  EXPECT_THAT(std::string(bucket.message()), HasSubstr("s3://globs/street/images"));
  EXPECT_THAT(std::string(bucket.message()), HasSubstr("check the bucket's name"));
  EXPECT_TRUE(absl::IsInvalidArgument(error("s3:///images")));
  WriteKeys("another secret");
  const absl::Status rights = error(Url("images"));
  EXPECT_TRUE(absl::IsPermissionDenied(rights)) << rights;
  EXPECT_THAT(std::string(rights.message()), HasSubstr("the keys need the rights"));
}

TEST_F(ObjectPlaceTest, SaysThatATableOrMasksAreMissing) {
  WriteStreet();
  ScanRequest request = InStore();
  request.gnss_table = Url("missing.csv");
  const absl::Status table = Scan(request).status();
  EXPECT_TRUE(absl::IsNotFound(table)) << table;
  EXPECT_THAT(std::string(table.message()), HasSubstr("no object s3://blobs/street/missing.csv"));
  request.gnss_table = store_.Url("");
  EXPECT_TRUE(absl::IsInvalidArgument(Scan(request).status()));
  request = InStore();
  request.masks = Url("no_masks");
  const absl::Status masks = Scan(request).status();
  EXPECT_TRUE(absl::IsNotFound(masks)) << masks;
  EXPECT_THAT(std::string(masks.message()), HasSubstr("s3://blobs/street/no_masks"));
}

TEST_F(ObjectPlaceTest, RefusesAKeyThatNoFolderCouldHave) {
  for (const char* key : {"street/images//a.jpg", "street/images/b//a.jpg"}) {
    WriteStreet();
    store_.SetObject(key, EncodedImage(64, 32, ".jpg"));
    const absl::Status status = Scan(InStore()).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr("a.jpg"));
    store_.RemoveObject(key);
  }
  store_.SetObject("street/images/../../up.jpg", EncodedImage(64, 32, ".jpg"));
  ExpectSame(*Scan(InStore()), *Scan(InFolder()));  // hidden, as all that begins with a dot
}

TEST_F(ObjectPlaceTest, TakesAWholeBucket) {
  store_.SetObject("a.jpg", EncodedImage(64, 32, ".jpg"));
  store_.SetObject("b/c.jpg", EncodedImage(64, 32, ".jpg"));
  const auto scanned = Scan({.image_folder = store_.Url(""), .store_keys = folder_ / "keys"});
  ASSERT_TRUE(scanned.ok()) << scanned.status();
  ASSERT_EQ(scanned->images.size(), 2U);
  EXPECT_EQ(scanned->images[1].path, "s3://blobs/b/c.jpg");
}

TEST_F(ObjectPlaceTest, ReportsHowFarItIsAndStopsWhenAsked) {
  WriteStreet();
  std::map<std::string, uint64_t> most;
  StageContext context;
  context.report = [&](const Progress& progress) {
    most[progress.unit] = std::max(most[progress.unit], progress.done);
  };
  ASSERT_TRUE(Scan(InStore(), context).ok());
  EXPECT_GE(most["objects"], 10U);
  EXPECT_EQ(most["images"], 6U);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(absl::IsCancelled(Scan(InStore(), {.stop = stop.get_token()}).status()));
}

TEST_F(ObjectPlaceTest, ReadsEachObjectOnce) {
  WriteStreet();
  ASSERT_TRUE(Scan(InStore()).ok());
  // The table, the pages of two lists (11 and 2 objects by threes), six images and a mask.
  EXPECT_EQ(store_.Count("GET"), 1U + 4U + 1U + 6U + 1U);
  EXPECT_EQ(store_.Count("PUT") + store_.Count("DELETE"), 0U);
}

}  // namespace
}  // namespace orbweave
