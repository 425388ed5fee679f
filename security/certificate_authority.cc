// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate_authority.h"

#include <arpa/inet.h>
#include <openssl/pem.h>

#include <array>

#include "absl/strings/str_cat.h"
#include "security/certificate_request.h"

namespace orbweave {
namespace {

constexpr int kSerialBits = 159;
constexpr int64_t kLateClocks_s = 300;

absl::Status CannotIssue() {
  return OpenSslError(absl::StatusCode::kInvalidArgument, "make the certificate");
}

bool SetSerial(X509& certificate) {
  const NumberHandle number(BN_new());
  return BN_rand(number.get(), kSerialBits, BN_RAND_TOP_ANY, BN_RAND_BOTTOM_ANY) == 1 &&
         BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(&certificate)) != nullptr;
}

bool SetDates(X509& certificate, int64_t now_unix_s, int64_t valid_s) {
  return ASN1_TIME_set(X509_getm_notBefore(&certificate), now_unix_s - kLateClocks_s) != nullptr &&
         ASN1_TIME_set(X509_getm_notAfter(&certificate), now_unix_s + valid_s) != nullptr;
}

bool SetName(X509_NAME* name, const std::string& fleet, const std::string& common_name) {
  const auto add = [name](const char* field, const std::string& text) {
    return X509_NAME_add_entry_by_txt(name,
                                      field,
                                      MBSTRING_ASC,
                                      reinterpret_cast<const unsigned char*>(text.data()),
                                      static_cast<int>(text.size()),
                                      -1,
                                      0) == 1;
  };
  return add("O", fleet) && add("CN", common_name.substr(0, ub_common_name));
}

/// Adds an extension in OpenSSL's configuration syntax.
bool Extend(X509& certificate, X509& issuer, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, &issuer, &certificate, nullptr, nullptr, 0);
  const ExtensionHandle extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  return extension != nullptr && X509_add_ext(&certificate, extension.get(), -1) == 1;
}

/// "DNS:" or "IP:" and the host. The syntax of the extension separates by commas: none may be in
/// it.
absl::StatusOr<std::string> HostEntry(const std::string& host) {
  std::array<unsigned char, 16> address{};
  if (::inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
      ::inet_pton(AF_INET6, host.c_str(), address.data()) == 1) {
    return "IP:" + host;
  }
  if (CheckName(host).ok()) return "DNS:" + host;
  return absl::InvalidArgumentError(absl::StrCat("'", host, "' is no host name or IP address"));
}

absl::StatusOr<std::string> AlternativeNames(const CertificateOrder& order) {
  std::string names = "URI:" + order.identity.ToUri();
  for (const std::string& host : order.hosts) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string entry, HostEntry(host));
    absl::StrAppend(&names, ",", entry);
  }
  return names;
}

absl::StatusOr<RequestHandle> ReadRequest(std::string_view pem) {
  RequestHandle request(PEM_read_bio_X509_REQ(BioOf(pem).get(), nullptr, nullptr, nullptr));
  // The signature proves that who asks holds the private half.
  if (request == nullptr ||
      X509_REQ_verify(request.get(), X509_REQ_get0_pubkey(request.get())) != 1) {
    return OpenSslError(absl::StatusCode::kInvalidArgument, "read the certificate request");
  }
  return request;
}

absl::StatusOr<std::string> SignedPem(X509& certificate, EVP_PKEY& key) {
  const BioHandle text = EmptyBio();
  if (X509_sign(&certificate, &key, EVP_sha256()) == 0 ||
      PEM_write_bio_X509(text.get(), &certificate) != 1) {
    return CannotIssue();
  }
  return TextOf(*text);
}

}  // namespace

absl::StatusOr<CertifiedKey> CertificateAuthority::Make(const std::string& fleet,
                                                        int64_t now_unix_s,
                                                        int64_t valid_s) {
  ORBWEAVE_RETURN_IF_ERROR(CheckName(fleet));
  CertifiedKey own;
  ORBWEAVE_ASSIGN_OR_RETURN(own.key_pem, MakePrivateKey());
  ORBWEAVE_ASSIGN_OR_RETURN(const KeyHandle key, KeyFromPem(own.key_pem));
  const CertificateHandle made(X509_new());
  X509_NAME* name = X509_get_subject_name(made.get());
  const bool filled =
      X509_set_version(made.get(), X509_VERSION_3) == 1 && SetSerial(*made) &&
      SetDates(*made, now_unix_s, valid_s) && SetName(name, fleet, "Orbweave authority") &&
      X509_set_issuer_name(made.get(), name) == 1 && X509_set_pubkey(made.get(), key.get()) == 1 &&
      Extend(*made, *made, NID_basic_constraints, "critical,CA:TRUE,pathlen:0") &&
      Extend(*made, *made, NID_key_usage, "critical,keyCertSign,cRLSign") &&
      Extend(*made, *made, NID_subject_key_identifier, "hash");
  if (!filled) return CannotIssue();
  ORBWEAVE_ASSIGN_OR_RETURN(own.certificate_pem, SignedPem(*made, *key));
  return own;
}

absl::StatusOr<CertificateAuthority> CertificateAuthority::Load(const CertifiedKey& own) {
  CertificateAuthority authority;
  authority.certificate_pem_ = own.certificate_pem;
  ORBWEAVE_ASSIGN_OR_RETURN(authority.certificate_, CertificateFromPem(own.certificate_pem));
  ORBWEAVE_ASSIGN_OR_RETURN(authority.key_, KeyFromPem(own.key_pem));
  if (X509_check_private_key(authority.certificate_.get(), authority.key_.get()) != 1)
    return OpenSslError(absl::StatusCode::kInvalidArgument, "use the authority's key");
  std::array<char, 256> fleet{};
  X509_NAME_get_text_by_NID(X509_get_subject_name(authority.certificate_.get()),
                            NID_organizationName,
                            fleet.data(),
                            fleet.size());
  authority.fleet_ = fleet.data();
  ORBWEAVE_RETURN_IF_ERROR(CheckName(authority.fleet_));
  return authority;
}

absl::StatusOr<std::string> CertificateAuthority::Issue(std::string_view request_pem,
                                                        const CertificateOrder& order) const {
  if (order.identity.fleet != fleet_)
    return absl::InvalidArgumentError("this authority certifies for fleet " + fleet_);
  ORBWEAVE_RETURN_IF_ERROR(CheckName(order.identity.name));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string names, AlternativeNames(order));
  ORBWEAVE_ASSIGN_OR_RETURN(const RequestHandle request, ReadRequest(request_pem));
  const bool serves = order.identity.role == Role::kCoordinator;
  const CertificateHandle made(X509_new());
  X509& issuer = *certificate_;
  const bool filled =
      X509_set_version(made.get(), X509_VERSION_3) == 1 && SetSerial(*made) &&
      SetDates(*made, order.now_unix_s, order.valid_s) &&
      SetName(X509_get_subject_name(made.get()), fleet_, order.identity.name) &&
      X509_set_issuer_name(made.get(), X509_get_subject_name(&issuer)) == 1 &&
      X509_set_pubkey(made.get(), X509_REQ_get0_pubkey(request.get())) == 1 &&
      Extend(*made, issuer, NID_basic_constraints, "critical,CA:FALSE") &&
      Extend(*made, issuer, NID_key_usage, "critical,digitalSignature") &&
      Extend(*made, issuer, NID_ext_key_usage, serves ? "serverAuth" : "clientAuth") &&
      Extend(*made, issuer, NID_authority_key_identifier, "keyid:always") &&
      Extend(*made, issuer, NID_subject_alt_name, names);
  if (!filled) return CannotIssue();
  return SignedPem(*made, *key_);
}

}  // namespace orbweave
