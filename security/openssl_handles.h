// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/evp.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <memory>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

template <auto Free>
struct OpenSslDeleter {
  template <typename T>
  void operator()(T* pointer) const {
    Free(pointer);
  }
};

using BioHandle = std::unique_ptr<BIO, OpenSslDeleter<BIO_free_all>>;
using KeyHandle = std::unique_ptr<EVP_PKEY, OpenSslDeleter<EVP_PKEY_free>>;
using CertificateHandle = std::unique_ptr<X509, OpenSslDeleter<X509_free>>;
using RequestHandle = std::unique_ptr<X509_REQ, OpenSslDeleter<X509_REQ_free>>;
using ExtensionHandle = std::unique_ptr<X509_EXTENSION, OpenSslDeleter<X509_EXTENSION_free>>;
using NumberHandle = std::unique_ptr<BIGNUM, OpenSslDeleter<BN_free>>;
using NamesHandle = std::unique_ptr<GENERAL_NAMES, OpenSslDeleter<GENERAL_NAMES_free>>;

/// "cannot `action`: <OpenSSL's reason>"; empties OpenSSL's queue of errors.
[[nodiscard]] absl::Status OpenSslError(absl::StatusCode code, std::string_view action);

/// PEM in memory, for reading and for writing.
[[nodiscard]] BioHandle BioOf(std::string_view text);
[[nodiscard]] BioHandle EmptyBio();
[[nodiscard]] std::string TextOf(BIO& bio);

/// InvalidArgument: no such thing in the text. No passphrase is ever asked for.
[[nodiscard]] absl::StatusOr<KeyHandle> KeyFromPem(std::string_view pem);
[[nodiscard]] absl::StatusOr<CertificateHandle> CertificateFromPem(std::string_view pem);

}  // namespace orbweave
