// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_answers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kDate[] = "Wed, 21 Oct 2015 07:28:00 GMT";
constexpr int64_t kDate_s = 1445412480;

HttpAnswer Refusal(int status, const std::string& code, const std::string& message = "") {
  return {.status = status,
          .headers = {{"date", kDate}},
          .body = "<?xml version=\"1.0\"?>\n<Error><Code>" + code + "</Code><Message>" + message +
                  "</Message></Error>"};
}

absl::StatusCode CodeOf(const HttpAnswer& answer) {
  return StatusOfS3(answer, "s3://blobs/a", kDate_s).code();
}

TEST(StatusOfS3, TellsWhatAnAnswerMeans) {
  using Code = absl::StatusCode;
  EXPECT_EQ(CodeOf({.status = 200}), Code::kOk);
  EXPECT_EQ(CodeOf({.status = 206}), Code::kOk);
  EXPECT_EQ(CodeOf({.status = 404}), Code::kNotFound);  // HEAD has no body
  EXPECT_EQ(CodeOf(Refusal(404, "NoSuchKey")), Code::kNotFound);
  EXPECT_EQ(CodeOf(Refusal(404, "NoSuchBucket")), Code::kFailedPrecondition);
  EXPECT_EQ(CodeOf(Refusal(412, "PreconditionFailed")), Code::kAlreadyExists);
  EXPECT_EQ(CodeOf(Refusal(409, "ConditionalRequestConflict")), Code::kUnavailable);
  EXPECT_EQ(CodeOf(Refusal(416, "InvalidRange")), Code::kOutOfRange);
  for (const int status : {429, 500, 502, 503, 504})
    EXPECT_EQ(CodeOf({.status = status}), Code::kUnavailable) << status;
  EXPECT_EQ(CodeOf(Refusal(400, "RequestTimeout")), Code::kUnavailable);
  EXPECT_EQ(CodeOf(Refusal(501, "NotImplemented")), Code::kUnimplemented);
  EXPECT_EQ(CodeOf(Refusal(400, "XAmzContentSHA256Mismatch")), Code::kDataLoss);
  EXPECT_EQ(CodeOf(Refusal(403, "SignatureDoesNotMatch")), Code::kPermissionDenied);
  EXPECT_EQ(CodeOf(Refusal(403, "AccessDenied", "Request has expired")), Code::kUnavailable);
  EXPECT_EQ(CodeOf(Refusal(403, "AccessDenied", "Access Denied")), Code::kPermissionDenied);
}

TEST(StatusOfS3, SaysWhatTheServerSays) {
  const absl::Status status =
      StatusOfS3(Refusal(403, "AccessDenied", "no &lt;b&gt; &amp; c"), "s3://blobs/a", kDate_s);
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("s3://blobs/a: the store answers 403 AccessDenied, no <b> & c"));
  EXPECT_THAT(std::string(status.message()), Not(HasSubstr("clock")));
}

TEST(StatusOfS3, NamesAClockThatIsWrong) {
  const HttpAnswer refusal = Refusal(403, "RequestTimeTooSkewed", "The difference is too large");
  const absl::Status ahead = StatusOfS3(refusal, "a", kDate_s + 3000);
  EXPECT_TRUE(absl::IsUnavailable(ahead));
  EXPECT_THAT(std::string(ahead.message()),
              HasSubstr("the clock of this machine is 3000 s ahead of the store's"));
  EXPECT_THAT(std::string(StatusOfS3(refusal, "a", kDate_s - 1000).message()),
              HasSubstr("1000 s behind the store's"));
}

TEST(StatusOfS3, NamesTheRegionOfTheBucket) {
  HttpAnswer moved = Refusal(301, "PermanentRedirect");
  moved.headers["x-amz-bucket-region"] = "eu-west-3";
  const absl::Status status = StatusOfS3(moved, "a", kDate_s);
  EXPECT_TRUE(absl::IsFailedPrecondition(status));
  EXPECT_THAT(std::string(status.message()), HasSubstr("eu-west-3"));
}

constexpr char kPage[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<ListBucketResult xmlns=\"http://s3.amazonaws.com/doc/2006-03-01/\"><Name>blobs</Name>"
    "<EncodingType>url</EncodingType><KeyCount>2</KeyCount><MaxKeys>2</MaxKeys>"
    "<IsTruncated>true</IsTruncated><NextContinuationToken>1ueGcxLPRx1Tr/XYExHnhbYLgveDs2J/"
    "wm36Hy4vbOwM=</NextContinuationToken>"
    "<Contents><Key>a%2Fb%20c</Key><LastModified>2009-10-12T17:50:30.000Z</LastModified>"
    "<ETag>&quot;fba9&quot;</ETag><Size>434234</Size><StorageClass>STANDARD</StorageClass></"
    "Contents>"
    "<Contents><Key>z</Key><LastModified>2009-10-12T17:50:31.000Z</LastModified>"
    "<Size>0</Size></Contents></ListBucketResult>";

TEST(ParseObjectPage, TakesAPage) {
  const ObjectPage page = *ParseObjectPage(kPage);
  ASSERT_EQ(page.objects.size(), 2U);
  EXPECT_EQ(page.objects[0].key, "a/b c");
  EXPECT_EQ(page.objects[0].size_bytes, 434234U);
  EXPECT_EQ(page.objects[0].modified_unix_s, 1255369830);
  EXPECT_EQ(page.objects[1].key, "z");
  EXPECT_EQ(page.objects[1].size_bytes, 0U);
  EXPECT_EQ(page.next, "1ueGcxLPRx1Tr/XYExHnhbYLgveDs2J/wm36Hy4vbOwM=");
}

TEST(ParseObjectPage, TakesAnEmptyListThatIsTheLast) {
  const ObjectPage page =
      *ParseObjectPage("<ListBucketResult><IsTruncated>false</IsTruncated></ListBucketResult>");
  EXPECT_TRUE(page.objects.empty());
  EXPECT_EQ(page.next, "");
}

TEST(ParseObjectPage, RefusesWhatIsHalf) {
  const std::string whole = kPage;
  EXPECT_FALSE(ParseObjectPage("").ok());
  EXPECT_FALSE(ParseObjectPage("<html>a proxy</html>").ok());
  for (const char* needed : {"<Size>434234</Size>",
                             "<LastModified>2009-10-12T17:50:30.000Z</LastModified>",
                             "<NextContinuationToken>1ueGcxLPRx1Tr/XYExHnhbYLgveDs2J/"
                             "wm36Hy4vbOwM=</NextContinuationToken>"}) {
    std::string without = whole;
    without.erase(without.find(needed), std::string(needed).size());
    EXPECT_TRUE(absl::IsDataLoss(ParseObjectPage(without).status())) << needed;
  }
}

constexpr char kUploads[] =
    "<ListMultipartUploadsResult><EncodingType>url</EncodingType><Upload><Key>a%2Fb</Key>"
    "<UploadId>VXBsb2Fk&amp;x</UploadId><Initiated>2009-10-12T17:50:30.000Z</Initiated></Upload>"
    "</ListMultipartUploadsResult>";

TEST(ParseUploads, TakesNamesAndTimes) {
  const std::vector<UploadInfo> uploads = *ParseUploads(kUploads);
  ASSERT_EQ(uploads.size(), 1U);
  EXPECT_EQ(uploads[0].key, "a/b");
  EXPECT_EQ(uploads[0].upload, "VXBsb2Fk&x");
  EXPECT_EQ(uploads[0].begun_unix_s, 1255369830);
  EXPECT_TRUE(ParseUploads("<ListMultipartUploadsResult></ListMultipartUploadsResult>")->empty());
}

TEST(ParseUploads, RefusesWhatIsHalf) {
  EXPECT_FALSE(ParseUploads("<html>a proxy</html>").ok());
  for (const char* needed :
       {"<UploadId>VXBsb2Fk&amp;x</UploadId>", "<Initiated>2009-10-12T17:50:30.000Z</Initiated>"}) {
    std::string without = kUploads;
    without.erase(without.find(needed), std::string(needed).size());
    EXPECT_TRUE(absl::IsDataLoss(ParseUploads(without).status())) << needed;
  }
  EXPECT_EQ(*ParseUpload("<R><UploadId>7</UploadId></R>"), "7");
  EXPECT_TRUE(absl::IsDataLoss(ParseUpload("<R></R>").status()));
}

TEST(PartsXml, NamesPartsInOrder) {
  EXPECT_EQ(PartsXml({"\"a\"", "<&>"}),
            "<CompleteMultipartUpload><Part><PartNumber>1</PartNumber><ETag>\"a\"</ETag></Part>"
            "<Part><PartNumber>2</PartNumber><ETag>&lt;&amp;&gt;</ETag></Part>"
            "</CompleteMultipartUpload>");
}

TEST(StatusOfFinish, AnErrorMayComeAfterTheHead) {
  EXPECT_TRUE(StatusOfFinish({.status = 200, .body = "<R><ETag>x</ETag></R>"}, "x").ok());
  EXPECT_TRUE(absl::IsUnavailable(
      StatusOfFinish({.status = 200, .body = "  <Error><Code>InternalError</Code></Error>"}, "x")));
}

TEST(ParseHttpTime, TakesBothForms) {
  EXPECT_EQ(*ParseHttpTime(kDate), kDate_s);
  EXPECT_EQ(*ParseHttpTime("2009-10-12T17:50:30.000Z"), 1255369830);
  for (const char* text : {"", "yesterday", "2009-10-12", "Wed, 21 Oct 2015 07:28:00 CET"})
    EXPECT_FALSE(ParseHttpTime(text).ok()) << text;
}

}  // namespace
}  // namespace orbweave
