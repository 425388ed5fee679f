// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate.h"

#include <ctime>
#include <memory>
#include <vector>

#include "security/openssl_handles.h"

namespace orbweave {
namespace {

struct TextDeleter {
  void operator()(char* text) const { OPENSSL_free(text); }
};
using TextHandle = std::unique_ptr<char, TextDeleter>;

absl::StatusOr<int64_t> UnixFromAsn1(const ASN1_TIME* time) {
  std::tm utc{};
  if (ASN1_TIME_to_tm(time, &utc) != 1)
    return OpenSslError(absl::StatusCode::kInvalidArgument, "read the certificate's dates");
  return static_cast<int64_t>(::timegm(&utc));
}

absl::StatusOr<std::string> SerialOf(const X509& certificate) {
  const NumberHandle number(ASN1_INTEGER_to_BN(X509_get0_serialNumber(&certificate), nullptr));
  const TextHandle digits(number == nullptr ? nullptr : BN_bn2hex(number.get()));
  if (digits == nullptr)
    return OpenSslError(absl::StatusCode::kInvalidArgument, "read the certificate's number");
  return std::string(digits.get());
}

std::vector<std::string> IdentityUris(const X509& certificate) {
  const NamesHandle names(static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(&certificate, NID_subject_alt_name, nullptr, nullptr)));
  std::vector<std::string> uris;
  for (int i = 0; i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(names.get(), i);
    if (name->type != GEN_URI) continue;
    const ASN1_IA5STRING* text = name->d.uniformResourceIdentifier;
    std::string uri(reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)),
                    static_cast<size_t>(ASN1_STRING_length(text)));
    if (uri.starts_with(kIdentityScheme)) uris.push_back(std::move(uri));
  }
  return uris;
}

}  // namespace

absl::StatusOr<CertificateFacts> ReadCertificate(std::string_view pem) {
  ORBWEAVE_ASSIGN_OR_RETURN(const CertificateHandle certificate, CertificateFromPem(pem));
  const std::vector<std::string> uris = IdentityUris(*certificate);
  if (uris.size() != 1) {
    return absl::InvalidArgumentError(
        "the certificate does not have one alternative name orbweave://FLEET/ROLE/NAME");
  }
  CertificateFacts facts;
  ORBWEAVE_ASSIGN_OR_RETURN(facts.identity, Identity::FromUri(uris[0]));
  ORBWEAVE_ASSIGN_OR_RETURN(facts.serial, SerialOf(*certificate));
  ORBWEAVE_ASSIGN_OR_RETURN(facts.begins_unix_s,
                            UnixFromAsn1(X509_get0_notBefore(certificate.get())));
  ORBWEAVE_ASSIGN_OR_RETURN(facts.ends_unix_s, UnixFromAsn1(X509_get0_notAfter(certificate.get())));
  return facts;
}

}  // namespace orbweave
