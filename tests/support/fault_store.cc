// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/fault_store.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <iomanip>
#include <list>
#include <optional>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "objects/s3_address.h"
#include "objects/sign_s3.h"
#include "security/unix_time.h"

namespace orbweave::testing {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

constexpr char kBucketPath[] = "/blobs";

std::string Text(boost::beast::string_view text) { return {text.data(), text.size()}; }

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::string FormatTime(int64_t unix_s, const char* form) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  std::ostringstream text;
  text << std::put_time(&utc, form);
  return text.str();
}

std::string HttpTime(int64_t unix_s) { return FormatTime(unix_s, "%a, %d %b %Y %H:%M:%S GMT"); }

int64_t UnixOf(const std::string& time) {
  std::tm utc{};
  if (::strptime(time.c_str(), "%Y%m%dT%H%M%SZ", &utc) == nullptr) return 0;
  return static_cast<int64_t>(::timegm(&utc));
}

std::string EtagOf(const std::string& bytes) {
  return absl::StrCat("\"", DigestOf(bytes).ToHex().substr(0, 32), "\"");
}

struct Question {
  std::string path{};
  std::map<std::string, std::string> query{};
};

Question QuestionOf(const std::string& target) {
  const size_t mark = std::min(target.find('?'), target.size());
  Question question{.path = target.substr(0, mark)};
  for (const std::string& part : Split(target.substr(std::min(mark + 1, target.size())), '&')) {
    const size_t equals = std::min(part.find('='), part.size());
    question.query[*UriDecode(part.substr(0, equals))] =
        *UriDecode(part.substr(std::min(equals + 1, part.size())));
  }
  return question;
}

struct Refused {
  int status = 403;
  std::string code{};
  std::string message{};
};

}  // namespace

/// One connection.
class FaultStoreTalk {
 public:
  FaultStoreTalk(FaultStore& store, tcp::socket& socket) : store_(store), socket_(socket) {}

  void Run() {
    while (TakeRequest()) {
    }
  }

 private:
  /// Whether the connection goes on.
  bool TakeRequest() {
    http::request_parser<http::string_body> parser;
    parser.body_limit(uint64_t{1} << 30);
    error_code error;
    http::read_header(socket_, buffer_, parser, error);
    if (error) return false;
    const std::optional<StoreFault> fault = Chance(parser.get(), parser.content_length());
    if (fault == StoreFault::kCutBody && parser.content_length().value_or(0) > 0) {
      std::string some(std::min<uint64_t>(*parser.content_length() / 2, 65536), ' ');
      asio::read(socket_, asio::buffer(some), asio::transfer_at_least(1), error);
      return false;
    }
    http::read(socket_, buffer_, parser, error);
    if (error) return false;
    return Answer(parser.release(), fault);
  }

  std::optional<StoreFault> Chance(const Request& request, boost::optional<uint64_t> length) {
    const std::string method = Text(request.method_string());
    const std::lock_guard lock(store_.mutex_);
    ++store_.counts_[method];
    for (const std::string& name : {method, std::string()}) {
      std::deque<StoreFault>& next = store_.next_faults_[name];
      if (next.empty()) continue;
      const StoreFault fault = next.front();
      next.pop_front();
      ++store_.faults_;
      return fault;
    }
    std::uniform_real_distribution<double> draw(0.0, 1.0);
    std::optional<StoreFault> fault;
    if (draw(store_.chance_) < store_.options_.slow_down_share) fault = StoreFault::kSlowDown;
    const bool has_body = method == "GET" || length.value_or(0) > 0;
    if (!fault && has_body && draw(store_.chance_) < store_.options_.cut_share)
      fault = StoreFault::kCutBody;
    if (fault) ++store_.faults_;
    return fault;
  }

  bool Answer(const Request& request, const std::optional<StoreFault>& fault) {
    std::this_thread::sleep_for(std::chrono::duration<double>(store_.options_.delay_s));
    Response response = Respond(request, fault);
    response.version(11);
    response.keep_alive(request.keep_alive());
    response.set(http::field::date, HttpTime(Now()));
    const bool is_head = request.method() == http::verb::head;
    if (is_head) {
      response.content_length(std::stoull(Text(response["x-length"])));
    } else {
      response.prepare_payload();
    }
    response.erase("x-length");
    http::response_serializer<http::string_body> serializer(response);
    error_code error;
    if (fault == StoreFault::kCutBody) return SendHalf(response);
    if (is_head) {
      http::write_header(socket_, serializer, error);
    } else {
      http::write(socket_, serializer, error);
    }
    return !error && request.keep_alive();
  }

  bool SendHalf(const Response& response) {
    std::ostringstream text;
    text << response.base() << response.body().substr(0, response.body().size() / 2);
    error_code error;
    asio::write(socket_, asio::buffer(text.str()), error);
    return false;
  }

  [[nodiscard]] int64_t Now() const { return UnixNow() + store_.options_.clock_ahead_s; }

  static Response Refuse(const Refused& refused) {
    Response response(static_cast<http::status>(refused.status), 11);
    response.set("x-length", "0");
    response.body() = absl::StrCat("<?xml version=\"1.0\"?><Error><Code>",
                                   refused.code,
                                   "</Code><Message>",
                                   refused.message,
                                   "</Message></Error>");
    return response;
  }

  Response Respond(const Request& request, const std::optional<StoreFault>& fault) {
    if (fault == StoreFault::kSlowDown) return Refuse({503, "SlowDown", "Reduce your rate"});
    if (fault == StoreFault::kConflict) return Refuse({409, "ConditionalRequestConflict", "again"});
    if (fault == StoreFault::kServerError) return Refuse({500, "InternalError", "oops"});
    const Question question = QuestionOf(Text(request.target()));
    if (const auto refused = CheckSignature(request, question)) return Refuse(*refused);
    if (!question.path.starts_with(kBucketPath))
      return Refuse({404, "NoSuchBucket", "there is no such bucket"});
    const std::string rest = question.path.substr(std::string(kBucketPath).size());
    if (rest.empty() && question.query.contains("uploads")) return ListUploads(question);
    if (rest.empty()) return List(question);
    const std::string key = *UriDecode(rest.substr(1));
    if (question.query.contains("uploads")) return BeginUpload(key);
    if (question.query.contains("uploadId")) return RespondToUpload(key, request, question);
    switch (request.method()) {
      case http::verb::put:
        return Put(key, request);
      case http::verb::delete_: {
        const std::lock_guard lock(store_.mutex_);
        store_.objects_.erase(key);
        return Response(http::status::no_content, 11);
      }
      default:
        return Get(key, request);
    }
  }

  std::optional<Refused> CheckSignature(const Request& request, const Question& question) {
    const auto asked = [&](const std::string& name) {
      const auto found = question.query.find(name);
      return found == question.query.end() ? std::string() : found->second;
    };
    {
      const std::lock_guard lock(store_.mutex_);
      store_.signers_.insert(Split(asked("X-Amz-Credential") + "/", '/').front());
    }
    S3Request signed_request{.method = Text(request.method_string()),
                             .host = Text(request[http::field::host]),
                             .path = question.path,
                             .query = question.query};
    signed_request.query.erase("X-Amz-Signature");
    for (const std::string& name : Split(asked("X-Amz-SignedHeaders"), ';')) {
      if (name != "host") signed_request.headers[name] = Text(request[name]);
    }
    const std::string hash = Text(request["x-amz-content-sha256"]);
    const std::string signature = SignatureOf(signed_request,
                                              hash.empty() ? kUnsignedPayload : hash,
                                              store_.options_.keys,
                                              asked("X-Amz-Date"));
    if (signature != asked("X-Amz-Signature")) return Refused{403, "SignatureDoesNotMatch", "no"};
    const int64_t begun_s = UnixOf(asked("X-Amz-Date"));
    if (begun_s > Now() + 900) return Refused{403, "RequestTimeTooSkewed", "too far ahead"};
    if (begun_s + std::stoll(asked("X-Amz-Expires")) < Now())
      return Refused{403, "AccessDenied", "Request has expired"};
    if (!hash.empty() && hash != DigestOf(request.body()).ToHex())
      return Refused{400, "XAmzContentSHA256Mismatch", "other bytes"};
    return std::nullopt;
  }

  Response Put(const std::string& key, const Request& request) {
    const bool has_condition = request.count(http::field::if_none_match) > 0;
    if (has_condition && !store_.options_.knows_conditions)
      return Refuse({501, "NotImplemented", "no conditions"});
    if (request.body().size() > store_.options_.most_put_bytes)
      return Refuse({400, "EntityTooLarge", "more than one request may bring"});
    const std::lock_guard lock(store_.mutex_);
    if (has_condition && store_.objects_.contains(key))
      return Refuse({412, "PreconditionFailed", "it is there"});
    store_.objects_[key] = {request.body(), UnixNow()};
    return Response(http::status::ok, 11);
  }

  Response BeginUpload(const std::string& key) {
    const std::lock_guard lock(store_.mutex_);
    const std::string upload = absl::StrCat("upload~/+", ++store_.begun_uploads_);
    store_.uploads_[upload] = {.key = key, .begun_unix_s = UnixNow()};
    Response response(http::status::ok, 11);
    response.body() = absl::StrCat("<InitiateMultipartUploadResult><UploadId>",
                                   upload,
                                   "</UploadId></InitiateMultipartUploadResult>");
    return response;
  }

  Response RespondToUpload(const std::string& key,
                           const Request& request,
                           const Question& question) {
    const std::lock_guard lock(store_.mutex_);
    const auto upload = store_.uploads_.find(question.query.at("uploadId"));
    if (upload == store_.uploads_.end() || upload->second.key != key)
      return Refuse({404, "NoSuchUpload", "there is no such upload"});
    if (request.method() == http::verb::put) {
      upload->second.parts[std::stoi(question.query.at("partNumber"))] = request.body();
      Response response(http::status::ok, 11);
      response.set(http::field::etag, EtagOf(request.body()));
      return response;
    }
    if (request.method() == http::verb::delete_) {
      store_.uploads_.erase(upload);
      return Response(http::status::no_content, 11);
    }
    return Complete(key, request, upload);
  }

  Response Complete(const std::string& key,
                    const Request& request,
                    std::map<std::string, FaultStore::Upload>::iterator upload) {
    if (request.count(http::field::if_none_match) > 0) {
      if (!store_.options_.knows_conditions)
        return Refuse({501, "NotImplemented", "no conditions"});
      if (store_.objects_.contains(key)) return Refuse({412, "PreconditionFailed", "it is there"});
    }
    std::string bytes;
    std::string expected = "<CompleteMultipartUpload>";
    size_t left = upload->second.parts.size();
    for (const auto& [number, part] : upload->second.parts) {
      absl::StrAppend(&expected,
                      "<Part><PartNumber>",
                      number,
                      "</PartNumber><ETag>",
                      EtagOf(part),
                      "</ETag></Part>");
      bytes += part;
      if (--left > 0 && part.size() < store_.options_.least_part_bytes)
        return Refuse({400, "EntityTooSmall", "a part is too small"});
    }
    if (request.body() != expected + "</CompleteMultipartUpload>")
      return Refuse({400, "InvalidPart", "other parts"});
    store_.objects_[key] = {bytes, UnixNow()};
    store_.uploads_.erase(upload);
    Response response(http::status::ok, 11);
    response.body() = "<CompleteMultipartUploadResult></CompleteMultipartUploadResult>";
    return response;
  }

  Response ListUploads(const Question& question) {
    const auto prefix = question.query.find("prefix");
    std::string xml = "<ListMultipartUploadsResult><EncodingType>url</EncodingType>";
    const std::lock_guard lock(store_.mutex_);
    for (const auto& [name, upload] : store_.uploads_) {
      if (prefix != question.query.end() && !upload.key.starts_with(prefix->second)) continue;
      absl::StrAppend(&xml,
                      "<Upload><Key>",
                      UriEncode(upload.key, true),
                      "</Key><UploadId>",
                      name,
                      "</UploadId><Initiated>",
                      FormatTime(upload.begun_unix_s, "%Y-%m-%dT%H:%M:%S.000Z"),
                      "</Initiated></Upload>");
    }
    Response response(http::status::ok, 11);
    response.body() = xml + "</ListMultipartUploadsResult>";
    return response;
  }

  Response Get(const std::string& key, const Request& request) {
    const std::lock_guard lock(store_.mutex_);
    const auto object = store_.objects_.find(key);
    if (object == store_.objects_.end()) return Refuse({404, "NoSuchKey", "there is no such key"});
    const std::string& bytes = object->second.bytes;
    const std::string etag = EtagOf(bytes);
    const std::string wanted = Text(request[http::field::if_match]);
    if (!wanted.empty() && wanted != etag)
      return Refuse({412, "PreconditionFailed", "it is another"});
    Response response(http::status::ok, 11);
    response.set(http::field::etag, etag);
    response.set(http::field::last_modified, HttpTime(object->second.modified_unix_s));
    response.set("x-length", std::to_string(bytes.size()));
    const std::string range = Text(request[http::field::range]);
    if (range.empty() || !store_.options_.gives_ranges) {
      response.body() = bytes;
      return response;
    }
    const size_t first = std::stoull(range.substr(std::string("bytes=").size()));
    const std::string last = range.substr(range.find('-') + 1);
    if (first >= bytes.size()) return Refuse({416, "InvalidRange", "too far"});
    response.result(http::status::partial_content);
    response.body() =
        bytes.substr(first, last.empty() ? std::string::npos : std::stoull(last) - first + 1);
    return response;
  }

  Response List(const Question& question) {
    const auto asked = [&](const std::string& name) {
      const auto found = question.query.find(name);
      return found == question.query.end() ? std::string() : found->second;
    };
    std::string xml = "<?xml version=\"1.0\"?><ListBucketResult><EncodingType>url</EncodingType>";
    const std::string prefix = asked("prefix");
    const std::lock_guard lock(store_.mutex_);
    size_t keys = 0;
    std::string last;
    for (auto it = store_.objects_.upper_bound(asked("continuation-token"));
         it != store_.objects_.end();
         ++it) {
      if (!it->first.starts_with(prefix)) continue;
      if (keys++ == store_.options_.page_keys) {
        absl::StrAppend(&xml,
                        "<IsTruncated>true</IsTruncated><NextContinuationToken>",
                        last,
                        "</NextContinuationToken>");
        break;
      }
      last = it->first;
      absl::StrAppend(&xml,
                      "<Contents><Key>",
                      UriEncode(it->first, true),
                      "</Key><LastModified>",
                      FormatTime(it->second.modified_unix_s, "%Y-%m-%dT%H:%M:%S.000Z"),
                      "</LastModified><ETag>&#34;",
                      EtagOf(it->second.bytes).substr(1, 32),
                      "&quot;</ETag><Size>",
                      it->second.bytes.size(),
                      "</Size></Contents>");
    }
    Response response(http::status::ok, 11);
    response.body() = xml + "</ListBucketResult>";
    return response;
  }

  FaultStore& store_;
  tcp::socket& socket_;
  boost::beast::flat_buffer buffer_;
};

/// A thread that accepts, and one for each connection.
class FaultStore::Listener {
 public:
  explicit Listener(FaultStore& store)
      : store_(store), acceptor_(context_, tcp::endpoint(asio::ip::address_v4::loopback(), 0)) {
    port_ = acceptor_.local_endpoint().port();
    thread_ = std::thread([this] { Accept(); });
  }
  ~Listener() {
    is_over_ = true;
    error_code ignored;
    tcp::socket wake(context_);
    wake.connect({asio::ip::address_v4::loopback(), port_}, ignored);
    thread_.join();
    {
      const std::lock_guard lock(mutex_);
      for (tcp::socket& socket : sockets_) socket.shutdown(tcp::socket::shutdown_both, ignored);
    }
    for (std::thread& talk : talks_) talk.join();
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] uint16_t port() const { return port_; }

 private:
  void Accept() {
    while (true) {
      error_code error;
      tcp::socket socket(context_);
      acceptor_.accept(socket, error);
      if (is_over_) return;
      if (error) continue;
      const std::lock_guard lock(mutex_);
      tcp::socket& kept = sockets_.emplace_back(std::move(socket));
      talks_.emplace_back([this, &kept] {
        FaultStoreTalk(store_, kept).Run();
        const std::lock_guard closing(mutex_);
        error_code ignored;
        kept.shutdown(tcp::socket::shutdown_both, ignored);
        kept.close(ignored);
      });
    }
  }

  FaultStore& store_;
  asio::io_context context_;
  tcp::acceptor acceptor_;
  uint16_t port_ = 0;
  std::atomic<bool> is_over_{false};
  std::mutex mutex_;
  std::list<tcp::socket> sockets_;
  std::list<std::thread> talks_;
  std::thread thread_;
};

FaultStore::FaultStore(FaultStoreOptions options)
    : options_(std::move(options)), listener_(std::make_unique<Listener>(*this)) {}

FaultStore::~FaultStore() = default;

std::string FaultStore::Url(const std::string& prefix) const {
  return absl::StrCat("s3://blobs/",
                      prefix,
                      "?endpoint=http://127.0.0.1:",
                      listener_->port(),
                      "&region=",
                      options_.keys.region);
}

void FaultStore::FailNext(const std::string& method, std::vector<StoreFault> faults) {
  const std::lock_guard lock(mutex_);
  next_faults_[method].assign(faults.begin(), faults.end());
}

std::map<std::string, std::string> FaultStore::Objects() {
  const std::lock_guard lock(mutex_);
  std::map<std::string, std::string> objects;
  for (const auto& [key, object] : objects_) objects[key] = object.bytes;
  return objects;
}

void FaultStore::SetObject(const std::string& key, const std::string& bytes) {
  const std::lock_guard lock(mutex_);
  objects_[key] = {bytes, UnixNow()};
}

void FaultStore::RemoveObject(const std::string& key) {
  const std::lock_guard lock(mutex_);
  objects_.erase(key);
}

size_t FaultStore::CountUploads() {
  const std::lock_guard lock(mutex_);
  return uploads_.size();
}

void FaultStore::AgeUploads(int64_t age_s) {
  const std::lock_guard lock(mutex_);
  for (auto& [name, upload] : uploads_) upload.begun_unix_s = UnixNow() - age_s;
}

void FaultStore::Age(const std::string& key, int64_t age_s) {
  const std::lock_guard lock(mutex_);
  objects_.at(key).modified_unix_s = UnixNow() - age_s;
}

uint64_t FaultStore::Count(const std::string& method) {
  const std::lock_guard lock(mutex_);
  return counts_[method];
}

uint64_t FaultStore::Faults() {
  const std::lock_guard lock(mutex_);
  return faults_;
}

std::set<std::string> FaultStore::Signers() {
  const std::lock_guard lock(mutex_);
  return signers_;
}

}  // namespace orbweave::testing
