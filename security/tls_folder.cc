// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/tls_folder.h"

#include <openssl/x509.h>

#include "security/openssl_handles.h"
#include "security/secret_file.h"

namespace orbweave {

absl::StatusOr<CertificateFacts> CheckTlsFolder(const TlsFolder& folder) {
  ORBWEAVE_RETURN_IF_ERROR(ReadTrustedFile(folder.AuthorityPath()).status());
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string key_pem, ReadSecretFile(folder.KeyPath()));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string own_pem, ReadSecretFile(folder.CertificatePath()));
  ORBWEAVE_ASSIGN_OR_RETURN(const KeyHandle key, KeyFromPem(key_pem));
  ORBWEAVE_ASSIGN_OR_RETURN(const CertificateHandle own, CertificateFromPem(own_pem));
  if (X509_check_private_key(own.get(), key.get()) != 1) {
    return absl::InvalidArgumentError(folder.KeyPath() + " is not the key of " +
                                      folder.CertificatePath());
  }
  absl::StatusOr<CertificateFacts> facts = ReadCertificate(own_pem);
  if (!facts.ok()) return Annotate(facts.status(), folder.CertificatePath());
  return facts;
}

}  // namespace orbweave
