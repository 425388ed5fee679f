// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/offer_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <set>

#include "core/base/status.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Files in memory, of this machine or elsewhere.
class MemoryPlace final : public FilePlace {
 public:
  explicit MemoryPlace(bool is_elsewhere) : is_elsewhere_(is_elsewhere) {}
  std::string Name() const override { return "memory"; }
  absl::StatusOr<std::vector<std::string>> List(const std::string&, const StageContext&) override {
    return absl::UnimplementedError("not listed");
  }
  std::string PathOf(const std::string& name) const override { return "memory/" + name; }
  absl::StatusOr<FileFacts> Look(const std::string&, const StageContext&) override {
    return absl::UnimplementedError("not looked at");
  }
  absl::StatusOr<std::string> Read(const std::string& path, const StageContext&) override {
    const auto found = files.find(path);
    if (found == files.end()) return absl::NotFoundError(path);
    return found->second;
  }
  bool IsElsewhere() const override { return is_elsewhere_; }

  std::map<std::string, std::string> files;

 private:
  const bool is_elsewhere_;
};

/// Remembers what it was told.
class NotingDepot final : public BlobDepot {
 public:
  absl::StatusOr<std::string> Get(const Digest&) override { return absl::NotFoundError("none"); }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    sent.insert(std::string(bytes));
    return DigestOf(bytes);
  }
  absl::StatusOr<std::vector<bool>> StatBlobs(const std::vector<Digest>& digests) override {
    std::vector<bool> is_known;
    for (const Digest& digest : digests) is_known.push_back(known.contains(digest));
    return is_known;
  }
  absl::Status LinkFile(const Digest&, const std::string& path) override {
    const std::lock_guard lock(mutex_);
    if (on_link.ok()) linked.insert(path);
    return on_link;
  }

  std::set<Digest> known;
  absl::Status on_link;  ///< what links are answered
  std::set<std::string> linked;
  std::multiset<std::string> sent;

 private:
  std::mutex mutex_;
};

/// Two images, one with a mask, and one that cannot be used.
class OfferFilesTest : public ::testing::TestWithParam<bool> {
 protected:
  OfferFilesTest() {
    auto images = std::make_unique<MemoryPlace>(GetParam());
    images->files = {{"a.jpg", "pixels a"}, {"b.jpg", "pixels b"}, {"text.jpg", "text"}};
    auto masks = std::make_unique<MemoryPlace>(GetParam());
    masks->files = {{"a.png", "mask a"}};
    images_ = images.get();
    places_.images = std::move(images);
    places_.masks = std::move(masks);
    sources_.images.resize(3);
    sources_.images[0] = {.name = "a.jpg", .path = "a.jpg", .content = DigestOf("pixels a")};
    sources_.images[0].mask_path = "a.png";
    sources_.images[0].mask = DigestOf("mask a");
    sources_.images[1] = {.name = "b.jpg", .path = "b.jpg", .content = DigestOf("pixels b")};
    sources_.images[2].path = "text.jpg";
    sources_.images[2].problem = "it is a text file";
  }
  absl::Status Offer() { return OfferFiles(depot_, sources_, places_, {}); }

  MemoryPlace* images_ = nullptr;
  ImagePlaces places_;
  ImageSources sources_;
  NotingDepot depot_;
};

TEST_P(OfferFilesTest, LinksWhatCanBeReadAndSendsNothing) {
  ASSERT_TRUE(Offer().ok());
  EXPECT_THAT(depot_.linked, ElementsAre("a.jpg", "a.png", "b.jpg"));
  EXPECT_THAT(depot_.sent, IsEmpty());
}

TEST_P(OfferFilesTest, SendsImagesAndMasksThatCannotBeLinked) {
  for (const absl::Status& refusal :
       {absl::NotFoundError("beneath no root"), absl::PermissionDeniedError("no right")}) {
    depot_.on_link = refusal;
    depot_.sent.clear();
    ASSERT_TRUE(Offer().ok());
    EXPECT_THAT(depot_.sent, ElementsAre("mask a", "pixels a", "pixels b"));
  }
}

TEST_P(OfferFilesTest, SendsTheMaskOfManyOnce) {
  depot_.on_link = absl::NotFoundError("beneath no root");
  sources_.images[1].mask_path = "a.png";
  sources_.images[1].mask = DigestOf("mask a");
  ASSERT_TRUE(Offer().ok());
  EXPECT_THAT(depot_.sent, ElementsAre("mask a", "pixels a", "pixels b"));
}

TEST_P(OfferFilesTest, SendsNothingThatIsKnown) {
  depot_.known = {DigestOf("pixels a"), DigestOf("pixels b"), DigestOf("mask a")};
  ASSERT_TRUE(Offer().ok());
  EXPECT_THAT(depot_.linked, IsEmpty());
  EXPECT_THAT(depot_.sent, IsEmpty());
}

TEST_P(OfferFilesTest, WhatPassesIsNoReasonToSend) {
  depot_.on_link = absl::UnavailableError("the store is away");
  EXPECT_TRUE(absl::IsUnavailable(Offer()));
  EXPECT_THAT(depot_.sent, IsEmpty());
}

TEST_P(OfferFilesTest, NamesAFileThatChangedOrWent) {
  depot_.on_link = absl::NotFoundError("beneath no root");
  images_->files["b.jpg"] = "other pixels";
  const absl::Status changed = Offer();
  EXPECT_TRUE(absl::IsDataLoss(changed)) << changed;
  EXPECT_NE(changed.message().find("b.jpg changed"), std::string::npos);
  images_->files.erase("b.jpg");
  EXPECT_TRUE(absl::IsNotFound(Offer()));
}

TEST_P(OfferFilesTest, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(absl::IsCancelled(OfferFiles(depot_, sources_, places_, {.stop = stop.get_token()})));
  EXPECT_THAT(depot_.linked, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(HereAndElsewhere, OfferFilesTest, ::testing::Bool());

}  // namespace
}  // namespace orbweave
