// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/coordinator_address.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "core/storage/durable_file.h"

namespace orbweave {
namespace {

using Json = nlohmann::ordered_json;

/// Empty: `json` does not say it.
std::string TextIn(const Json& json, const char* key) {
  const auto it = json.find(key);
  return it != json.end() && it->is_string() ? it->get<std::string>() : std::string();
}

}  // namespace

std::string AnnouncementToText(const Announcement& announcement) {
  const Json json = {{"address", announcement.address},
                     {"fleet", announcement.fleet},
                     {"build", announcement.build}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
}

absl::StatusOr<Announcement> AnnouncementFromText(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || TextIn(json, "address").empty())
    return absl::InvalidArgumentError("it does not say where a coordinator is");
  return Announcement{.address = TextIn(json, "address"),
                      .fleet = TextIn(json, "fleet"),
                      .build = TextIn(json, "build")};
}

absl::StatusOr<CoordinatorAddress> FindCoordinator(const std::string& named) {
  if (!named.starts_with('@')) return CoordinatorAddress{named};
  const std::string path = named.substr(1);
  const absl::StatusOr<std::string> text = ReadWholeFile(path);
  if (!text.ok()) return absl::UnavailableError(text.status().message());
  const absl::StatusOr<Announcement> announcement = AnnouncementFromText(*text);
  if (!announcement.ok())
    return absl::UnavailableError(absl::StrCat(path, ": ", announcement.status().message()));
  return CoordinatorAddress{announcement->address, KnownBy::kFleet};
}

}  // namespace orbweave
