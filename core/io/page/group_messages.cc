// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/group_messages.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

constexpr std::string_view kSpecific = "#";  // stands for what differs within a kind

bool IsLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Whether a word is a number or the name of a file: it has a digit, a slash, or a dot before a
/// letter.
bool IsSpecific(std::string_view word) {
  for (size_t i = 0; i < word.size(); ++i) {
    if (IsDigit(word[i]) || word[i] == '/') return true;
    if (word[i] == '.' && i > 0 && i + 1 < word.size() && IsLetter(word[i + 1])) return true;
  }
  return false;
}

bool EndsWord(char c) {
  return std::string_view(" \t\n,;:()'\"").find(c) != std::string_view::npos;
}

/// What messages of one kind have in common. Lists of names count as one name.
std::string KindOf(std::string_view message) {
  std::string kind;
  while (!message.empty()) {
    const size_t length =
        static_cast<size_t>(std::ranges::find_if(message, EndsWord) - message.begin());
    const std::string_view word = message.substr(0, length);
    kind += IsSpecific(word) ? kSpecific : word;
    if (kind.ends_with("#, #")) kind.erase(kind.size() - 3);
    if (length < message.size()) kind += message[length];
    message.remove_prefix(std::min(length + 1, message.size()));
  }
  return kind;
}

std::vector<MessageGroup> GroupReasons(std::span<const Exclusion> images) {
  std::vector<std::string> reasons;
  for (const Exclusion& image : images) reasons.push_back(image.reason);
  return GroupByKind(reasons);
}

std::string LineOf(const MessageGroup& group, std::span<const Exclusion> images) {
  const Exclusion& first = images[group.members.front()];
  if (group.members.size() == 1) return absl::StrCat(first.name, ": ", first.reason);
  const std::string count = CountText(group.members.size());
  if (!group.same_words)
    return absl::StrCat(count, " images, such as ", first.name, ": ", first.reason);
  return absl::StrCat(count, " images: ", first.reason, ", first ", first.name);
}

}  // namespace

std::vector<MessageGroup> GroupByKind(std::span<const std::string> messages) {
  std::vector<MessageGroup> groups;
  std::map<std::string, size_t> group_of_kind;
  for (size_t i = 0; i < messages.size(); ++i) {
    const auto [place, is_new] = group_of_kind.emplace(KindOf(messages[i]), groups.size());
    if (is_new) groups.emplace_back();
    MessageGroup& group = groups[place->second];
    group.members.push_back(i);
    if (messages[i] != messages[group.members.front()]) group.same_words = false;
  }
  return groups;
}

std::vector<std::string> CountedLines(std::span<const std::string> messages) {
  std::vector<std::string> lines;
  for (const MessageGroup& group : GroupByKind(messages)) {
    std::string& line = lines.emplace_back(messages[group.members.front()]);
    const size_t more = group.members.size() - 1;
    if (more > 0) absl::StrAppend(&line, " (and ", CountText(more), " more of this kind)");
  }
  return lines;
}

std::vector<std::string> CountedLines(std::span<const Exclusion> images) {
  std::vector<std::string> lines;
  for (const MessageGroup& group : GroupReasons(images)) lines.push_back(LineOf(group, images));
  return lines;
}

std::string CommonestLine(std::span<const Exclusion> images) {
  const std::vector<MessageGroup> groups = GroupReasons(images);
  const auto commonest = std::ranges::max_element(
      groups, {}, [](const MessageGroup& group) { return group.members.size(); });
  return commonest == groups.end() ? "" : LineOf(*commonest, images);
}

}  // namespace orbweave
