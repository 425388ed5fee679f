// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate_request.h"

#include <openssl/ec.h>
#include <openssl/pem.h>

#include "security/openssl_handles.h"

namespace orbweave {

absl::StatusOr<std::string> MakePrivateKey() {
  const KeyHandle key(EVP_EC_gen("P-256"));
  const BioHandle text = EmptyBio();
  if (key == nullptr || PEM_write_bio_PKCS8PrivateKey(
                            text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) != 1) {
    return OpenSslError(absl::StatusCode::kInternal, "make a key");
  }
  return TextOf(*text);
}

absl::StatusOr<std::string> MakeCertificateRequest(std::string_view key_pem) {
  ORBWEAVE_ASSIGN_OR_RETURN(const KeyHandle key, KeyFromPem(key_pem));
  const RequestHandle request(X509_REQ_new());
  const BioHandle text = EmptyBio();
  const bool made = X509_REQ_set_version(request.get(), X509_REQ_VERSION_1) == 1 &&
                    X509_REQ_set_pubkey(request.get(), key.get()) == 1 &&
                    X509_REQ_sign(request.get(), key.get(), EVP_sha256()) > 0 &&
                    PEM_write_bio_X509_REQ(text.get(), request.get()) == 1;
  if (!made) return OpenSslError(absl::StatusCode::kInternal, "request a certificate");
  return TextOf(*text);
}

}  // namespace orbweave
