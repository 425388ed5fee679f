// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/key_store.h"

#include <sys/stat.h>

#include <cerrno>
#include <filesystem>

#include "security/certificate_authority.h"
#include "security/certificate_request.h"
#include "security/join_token.h"
#include "security/secret_file.h"
#include "security/tls_folder.h"

namespace orbweave {
namespace {

constexpr int64_t kAuthorityValid_s = int64_t{3650} * 86400;

TlsFolder AuthorityFolder(const std::string& store) { return {store + "/authority"}; }

/// AlreadyExists when it is there.
absl::Status MakeOwnFolder(const std::string& path) {
  if (::mkdir(path.c_str(), S_IRWXU) == 0) return absl::OkStatus();
  if (errno == EEXIST) {
    return absl::AlreadyExistsError(path + " is there already; keys are never overwritten");
  }
  return absl::ErrnoToStatus(errno, "cannot make folder " + path);
}

absl::StatusOr<CertificateAuthority> LoadAuthority(const std::string& store) {
  const TlsFolder folder = AuthorityFolder(store);
  CertifiedKey own;
  ORBWEAVE_ASSIGN_OR_RETURN(own.certificate_pem, ReadSecretFile(folder.AuthorityPath()));
  ORBWEAVE_ASSIGN_OR_RETURN(own.key_pem, ReadSecretFile(folder.AuthorityKeyPath()));
  return CertificateAuthority::Load(own);
}

/// The folders in `store` that hold a coordinator's keys.
std::vector<TlsFolder> CoordinatorFolders(const std::string& store) {
  std::vector<TlsFolder> folders;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(store, ignored)) {
    const TlsFolder folder{entry.path().string()};
    const absl::StatusOr<CertificateFacts> own = CheckTlsFolder(folder);
    if (own.ok() && own->identity.role == Role::kCoordinator) folders.push_back(folder);
  }
  return folders;
}

absl::Status Copy(const std::string& from, const std::string& to) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadSecretFile(from));
  return WriteSecretFile(to, bytes);
}

}  // namespace

absl::Status MakeKeyStore(const std::string& store,
                          const std::string& fleet,
                          const std::vector<std::string>& hosts,
                          int64_t now_unix_s) {
  ORBWEAVE_ASSIGN_OR_RETURN(const CertifiedKey own,
                            CertificateAuthority::Make(fleet, now_unix_s, kAuthorityValid_s));
  const TlsFolder authority = AuthorityFolder(store);
  std::error_code ignored;  // MakeOwnFolder says what is wrong
  std::filesystem::create_directories(store, ignored);
  ORBWEAVE_RETURN_IF_ERROR(MakeOwnFolder(authority.path));
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(authority.AuthorityPath(), own.certificate_pem));
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(authority.AuthorityKeyPath(), own.key_pem));
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(authority.TokenKeyPath(), MakeTokenKey()));
  for (const Role role : {Role::kCoordinator, Role::kClient, Role::kAdmin}) {
    const NewKeys keys{.role = role,
                       .name = std::string(RoleName(role)),
                       .hosts = role == Role::kCoordinator ? hosts : std::vector<std::string>()};
    ORBWEAVE_RETURN_IF_ERROR(AddKeys(store, keys, now_unix_s));
  }
  const TlsFolder coordinator{store + "/coordinator"};
  ORBWEAVE_RETURN_IF_ERROR(Copy(authority.AuthorityKeyPath(), coordinator.AuthorityKeyPath()));
  return Copy(authority.TokenKeyPath(), coordinator.TokenKeyPath());
}

absl::Status AddKeys(const std::string& store, const NewKeys& keys, int64_t now_unix_s) {
  ORBWEAVE_RETURN_IF_ERROR(CheckName(keys.name));
  ORBWEAVE_ASSIGN_OR_RETURN(const CertificateAuthority authority, LoadAuthority(store));
  ORBWEAVE_ASSIGN_OR_RETURN(const Revocations revoked,
                            ReadRevocations(AuthorityFolder(store).RevocationsPath()));
  if (revoked.names.contains(keys.name))
    return absl::FailedPreconditionError(keys.name + " is revoked: give another name");
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string key, MakePrivateKey());
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string request, MakeCertificateRequest(key));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string certificate,
                            authority.Issue(request,
                                            {.identity = {authority.fleet(), keys.role, keys.name},
                                             .hosts = keys.hosts,
                                             .now_unix_s = now_unix_s,
                                             .valid_s = keys.valid_s}));
  const TlsFolder folder{store + "/" + keys.name};
  ORBWEAVE_RETURN_IF_ERROR(MakeOwnFolder(folder.path));
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(folder.AuthorityPath(), authority.certificate_pem()));
  if (keys.role == Role::kCoordinator && revoked != Revocations()) {
    ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(folder.RevocationsPath(), RevocationsToText(revoked)));
  }
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(folder.KeyPath(), key));
  return WriteSecretFile(folder.CertificatePath(), certificate);
}

absl::Status Revoke(const std::string& store, const Revocations& more) {
  const absl::StatusOr<Revocations> checked = RevocationsFromText(RevocationsToText(more));
  if (!checked.ok() || *checked != more)
    return absl::InvalidArgumentError(
        "give a participant's name, a certificate's serial number or a join token's number");
  const TlsFolder authority = AuthorityFolder(store);
  ORBWEAVE_RETURN_IF_ERROR(ReadSecretFile(authority.AuthorityPath()).status());
  const std::vector<TlsFolder> coordinators = CoordinatorFolders(store);
  for (const TlsFolder& folder : coordinators) {
    ORBWEAVE_ASSIGN_OR_RETURN(const CertificateFacts own, CheckTlsFolder(folder));
    if (more.names.contains(own.identity.name) || more.serials.contains(own.serial)) {
      return absl::InvalidArgumentError(
          own.identity.name + " is a coordinator, whose callers would not ask: make new keys");
    }
  }
  ORBWEAVE_ASSIGN_OR_RETURN(Revocations revoked, ReadRevocations(authority.RevocationsPath()));
  revoked.names.insert(more.names.begin(), more.names.end());
  revoked.serials.insert(more.serials.begin(), more.serials.end());
  revoked.tokens.insert(more.tokens.begin(), more.tokens.end());
  const std::string text = RevocationsToText(revoked);
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(authority.RevocationsPath(), text));
  for (const TlsFolder& folder : coordinators)
    ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(folder.RevocationsPath(), text));
  return absl::OkStatus();
}

absl::StatusOr<std::string> WriteJoinToken(const std::string& store,
                                           const std::string& path,
                                           int64_t expires_unix_s,
                                           uint32_t uses) {
  ORBWEAVE_ASSIGN_OR_RETURN(const CertificateAuthority authority, LoadAuthority(store));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string key,
                            ReadSecretFile(AuthorityFolder(store).TokenKeyPath()));
  const std::string token = MakeJoinToken(key,
                                          {.fleet = authority.fleet(),
                                           .role = Role::kWorker,
                                           .expires_unix_s = expires_unix_s,
                                           .uses = uses,
                                           .authority_pem = authority.certificate_pem()});
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(path, token));
  ORBWEAVE_ASSIGN_OR_RETURN(const JoinClaims claims, ReadJoinToken(token));
  return claims.nonce;
}

}  // namespace orbweave
