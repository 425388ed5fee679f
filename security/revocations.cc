// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/revocations.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "security/join_token.h"
#include "security/secret_file.h"

namespace orbweave {
namespace {

constexpr size_t kLongestSerial = 64;

bool IsSerial(std::string_view text) {
  return !text.empty() && text.size() <= kLongestSerial &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return absl::ascii_isdigit(static_cast<unsigned char>(c)) || (c >= 'A' && c <= 'F');
         });
}

/// What tells one state of a file from the next; empty: there is none.
std::string StateOf(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return errno == ENOENT ? "" : "unreadable";
  return absl::StrCat(info.st_ino,
                      " ",
                      info.st_size,
                      " ",
                      info.st_mtim.tv_sec,
                      ".",
                      info.st_mtim.tv_nsec,
                      " ",
                      info.st_ctim.tv_sec,
                      ".",
                      info.st_ctim.tv_nsec);
}

}  // namespace

std::string RevocationsToText(const Revocations& revoked) {
  std::string text;
  for (const std::string& name : revoked.names) absl::StrAppend(&text, "name ", name, "\n");
  for (const std::string& serial : revoked.serials) absl::StrAppend(&text, "serial ", serial, "\n");
  for (const std::string& token : revoked.tokens) absl::StrAppend(&text, "token ", token, "\n");
  return text;
}

absl::StatusOr<Revocations> RevocationsFromText(std::string_view text) {
  Revocations revoked;
  const std::vector<std::string> lines =
      absl::StrSplit(absl::string_view(text.data(), text.size()), '\n', absl::SkipEmpty());
  for (const std::string& line : lines) {
    const std::vector<std::string> words = absl::StrSplit(line, ' ');
    if (words.size() == 2 && words[0] == "name" && CheckName(words[1]).ok()) {
      revoked.names.insert(words[1]);
    } else if (words.size() == 2 && words[0] == "serial" && IsSerial(words[1])) {
      revoked.serials.insert(words[1]);
    } else if (words.size() == 2 && words[0] == "token" && IsTokenNonce(words[1])) {
      revoked.tokens.insert(words[1]);
    } else {
      return absl::InvalidArgumentError(
          "not a list of revocations: each line is 'name NAME', 'serial DIGITS' or 'token "
          "DIGITS'");
    }
  }
  return revoked;
}

absl::StatusOr<Revocations> ReadRevocations(const std::string& path) {
  const absl::StatusOr<std::string> text = ReadSecretFile(path);
  if (absl::IsNotFound(text.status())) return Revocations();
  ORBWEAVE_RETURN_IF_ERROR(text.status());
  const absl::StatusOr<Revocations> revoked = RevocationsFromText(*text);
  if (!revoked.ok()) return Annotate(revoked.status(), path);
  return *revoked;
}

absl::StatusOr<std::shared_ptr<RevocationList>> RevocationList::Open(const std::string& path,
                                                                     OnUnreadable on_unreadable) {
  std::shared_ptr<RevocationList> list(new RevocationList(path, std::move(on_unreadable)));
  ORBWEAVE_RETURN_IF_ERROR(list->Refresh());
  return list;
}

absl::Status RevocationList::Refresh() {
  std::string state = StateOf(path_);
  if (state == state_) return absl::OkStatus();
  state_ = std::move(state);
  ORBWEAVE_ASSIGN_OR_RETURN(revoked_, ReadRevocations(path_));
  return absl::OkStatus();
}

void RevocationList::RefreshOrTell() {
  if (const absl::Status read = Refresh(); !read.ok() && on_unreadable_) on_unreadable_(read);
}

absl::Status RevocationList::CheckToken(const std::string& nonce) {
  const std::lock_guard lock(mutex_);
  RefreshOrTell();
  if (!revoked_.tokens.contains(nonce)) return absl::OkStatus();
  return absl::PermissionDeniedError("the join token is revoked: ask for a new one");
}

absl::Status RevocationList::Check(const Identity& holder, std::string_view certificate_pem) {
  const std::lock_guard lock(mutex_);
  RefreshOrTell();
  if (revoked_.names.contains(holder.name))
    return absl::PermissionDeniedError(absl::StrCat(holder.ToUri(), " is revoked"));
  if (revoked_.serials.empty()) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(const CertificateFacts own, ReadCertificate(certificate_pem));
  if (!revoked_.serials.contains(own.serial)) return absl::OkStatus();
  return absl::PermissionDeniedError(
      absl::StrCat("the certificate of ", holder.ToUri(), " is revoked"));
}

}  // namespace orbweave
