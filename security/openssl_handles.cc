// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/openssl_handles.h"

#include <openssl/err.h>
#include <openssl/pem.h>

#include <array>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

/// A key behind a passphrase is refused rather than asked for on the terminal.
int NoPassphrase(char*, int, int, void*) { return -1; }

}  // namespace

absl::Status OpenSslError(absl::StatusCode code, std::string_view action) {
  std::array<char, 256> reason{};
  ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
  ERR_clear_error();
  return {code, absl::StrCat("cannot ", std::string(action), ": ", reason.data())};
}

BioHandle BioOf(std::string_view text) {
  return BioHandle(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

BioHandle EmptyBio() { return BioHandle(BIO_new(BIO_s_mem())); }

std::string TextOf(BIO& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(&bio, &data);
  return {data, static_cast<size_t>(size)};
}

absl::StatusOr<KeyHandle> KeyFromPem(std::string_view pem) {
  KeyHandle key(PEM_read_bio_PrivateKey(BioOf(pem).get(), nullptr, NoPassphrase, nullptr));
  if (key == nullptr) return OpenSslError(absl::StatusCode::kInvalidArgument, "read the key");
  return key;
}

absl::StatusOr<CertificateHandle> CertificateFromPem(std::string_view pem) {
  CertificateHandle certificate(
      PEM_read_bio_X509(BioOf(pem).get(), nullptr, NoPassphrase, nullptr));
  if (certificate == nullptr)
    return OpenSslError(absl::StatusCode::kInvalidArgument, "read the certificate");
  return certificate;
}

}  // namespace orbweave
