// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/identity.h"

#include <algorithm>
#include <array>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace orbweave {
namespace {

constexpr size_t kLongestName = 100;
constexpr std::array<std::string_view, 4> kRoleNames = {"coordinator", "worker", "client", "admin"};

absl::Status NoIdentity(std::string_view uri) {
  return absl::InvalidArgumentError(absl::StrCat(
      "'", std::string(uri), "' is no identity of the form orbweave://FLEET/ROLE/NAME"));
}

}  // namespace

std::string_view RoleName(Role role) { return kRoleNames[static_cast<size_t>(role)]; }

absl::StatusOr<Role> RoleFromName(std::string_view name) {
  const auto* const found = std::find(kRoleNames.begin(), kRoleNames.end(), name);
  if (found != kRoleNames.end()) return static_cast<Role>(found - kRoleNames.begin());
  return absl::InvalidArgumentError(absl::StrCat(
      "'", std::string(name), "' is no role: give coordinator, worker, client or admin"));
}

std::string Identity::ToUri() const {
  return absl::StrCat(
      std::string(kIdentityScheme), fleet, "/", std::string(RoleName(role)), "/", name);
}

absl::StatusOr<Identity> Identity::FromUri(std::string_view uri) {
  if (!uri.starts_with(kIdentityScheme)) return NoIdentity(uri);
  const std::string rest(uri.substr(kIdentityScheme.size()));
  const std::vector<std::string> parts = absl::StrSplit(rest, '/');
  if (parts.size() != 3) return NoIdentity(uri);
  const absl::StatusOr<Role> role = RoleFromName(parts[1]);
  if (!role.ok() || !CheckName(parts[0]).ok() || !CheckName(parts[2]).ok()) return NoIdentity(uri);
  return Identity{.fleet = parts[0], .role = *role, .name = parts[2]};
}

absl::Status CheckName(std::string_view name) {
  const auto is_allowed = [](char c) {
    return absl::ascii_isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '-';
  };
  if (!name.empty() && name.size() <= kLongestName &&
      absl::ascii_isalnum(static_cast<unsigned char>(name[0])) &&
      std::all_of(name.begin(), name.end(), is_allowed)) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrCat("a name has 1 to ",
                   kLongestName,
                   " letters, digits, '.', '_' and '-', and begins with a letter or digit"));
}

bool MaySpeakFor(const Identity& identity, std::string_view worker_name) {
  if (identity.role == Role::kAdmin) return true;
  if (identity.role != Role::kWorker || !worker_name.starts_with(identity.name)) return false;
  const std::string_view rest = worker_name.substr(identity.name.size());
  return rest.empty() || (rest[0] == '/' && CheckName(rest.substr(1)).ok());
}

}  // namespace orbweave
