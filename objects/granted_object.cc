// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/granted_object.h"

#include <random>

#include "absl/strings/str_cat.h"
#include "core/base/sleep.h"
#include "objects/s3_answers.h"
#include "security/unix_time.h"

namespace orbweave {
namespace {

std::string RangeHeader(uint64_t first, const std::optional<ByteRange>& range) {
  return absl::StrCat("range: bytes=", first, "-", range ? absl::StrCat(range->last) : "");
}

/// A read that goes on where it ended.
class ResumedRead {
 public:
  ResumedRead(const ObjectGrant& grant,
              const std::optional<ByteRange>& range,
              const TakePiece& take)
      : grant_(grant), range_(range), take_(take) {}

  [[nodiscard]] HttpCall NextCall() {
    HttpCall call{.url = grant_.url, .headers = grant_.headers};
    const uint64_t first = (range_ ? range_->first : 0) + taken_bytes_;
    if (range_ || first > 0) call.headers.push_back(RangeHeader(first, range_));
    call.take = [this](std::string_view piece) {
      refusal_ = take_(piece);
      if (refusal_.ok()) taken_bytes_ += piece.size();
      return refusal_;
    };
    return call;
  }

  /// A server that gives the whole where a part was asked for would have it taken twice.
  [[nodiscard]] bool IsAsAsked(const HttpAnswer& answer) const {
    return answer.status == 206 || (!range_ && !had_bytes_);
  }
  void Note() { had_bytes_ = taken_bytes_ > 0; }
  [[nodiscard]] const absl::Status& refusal() const { return refusal_; }

 private:
  const ObjectGrant& grant_;
  const std::optional<ByteRange>& range_;
  const TakePiece& take_;
  uint64_t taken_bytes_ = 0;
  bool had_bytes_ = false;  ///< before the present attempt
  absl::Status refusal_;
};

}  // namespace

double PauseBefore_s(int attempt) {
  thread_local std::mt19937 generator{std::random_device{}()};
  std::uniform_real_distribution<double> spread(0.5, 1.5);
  double pause_s = 0.1;
  for (int i = 1; i < attempt; ++i) pause_s *= 2.0;
  return pause_s * spread(generator);
}

absl::Status ReadGranted(HttpClient& http,
                         const ObjectGrant& grant,
                         const std::optional<ByteRange>& range,
                         const std::string& what,
                         const TakePiece& take) {
  ResumedRead read(grant, range, take);
  absl::Status status;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    if (attempt > 0) SleepUnlessStopped(PauseBefore_s(attempt), {});
    read.Note();
    const absl::StatusOr<HttpAnswer> answer = http.Do(read.NextCall());
    if (!read.refusal().ok()) return read.refusal();
    status = answer.ok() ? StatusOfS3(*answer, what, UnixNow()) : answer.status();
    if (status.ok() && !read.IsAsAsked(*answer))
      return absl::UnavailableError(absl::StrCat(what, ": the store gives no parts of objects"));
    if (!absl::IsUnavailable(status)) return status;
  }
  return status;
}

absl::Status WriteGranted(HttpClient& http,
                          const ObjectGrant& grant,
                          uint64_t size_bytes,
                          const std::string& what,
                          const NextPiece& next) {
  ORBWEAVE_ASSIGN_OR_RETURN(const HttpAnswer answer,
                            http.Do({.method = "PUT",
                                     .url = grant.url,
                                     .headers = grant.headers,
                                     .body_bytes = size_bytes,
                                     .next = next}));
  const absl::Status status = StatusOfS3(answer, what, UnixNow());
  return absl::IsAlreadyExists(status) ? absl::OkStatus() : status;
}

absl::StatusOr<std::string> WriteGrantedPart(HttpClient& http,
                                             const ObjectGrant& grant,
                                             std::string_view bytes,
                                             const std::string& what) {
  ORBWEAVE_ASSIGN_OR_RETURN(const HttpAnswer answer,
                            http.Do({.method = "PUT",
                                     .url = grant.url,
                                     .headers = grant.headers,
                                     .body_bytes = bytes.size(),
                                     .next = PiecesOf(bytes)}));
  ORBWEAVE_RETURN_IF_ERROR(StatusOfS3(answer, what, UnixNow()));
  std::string etag = answer.Header("etag");
  if (etag.empty()) return absl::DataLossError(what + ": the store gives no ETag of a part");
  return etag;
}

}  // namespace orbweave
