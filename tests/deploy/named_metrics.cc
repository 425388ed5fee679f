// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/deploy/named_metrics.h"

#include <regex>
#include <sstream>

namespace orbweave::deploy {
namespace {

std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> pieces;
  std::istringstream stream(text);
  for (std::string piece; std::getline(stream, piece, at);) pieces.push_back(piece);
  return pieces;
}

/// All places where an expression fits.
std::vector<std::smatch> Matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

}  // namespace

std::vector<NamedMetric> MetricsNamedIn(std::string_view expression) {
  static const std::regex kMetric(R"((orbweave_[a-z_]+)(\{[^}]*\})?)");
  static const std::regex kMatcher(R"re((\w+)\s*(=~|!=|!~|=)\s*"([^"]*)")re");
  const std::string text(expression);
  std::vector<NamedMetric> metrics;
  for (const std::smatch& match : Matches(text, kMetric)) {
    NamedMetric& metric = metrics.emplace_back(NamedMetric{.name = match[1]});
    const std::string matchers = match[2];
    for (const std::smatch& matcher : Matches(matchers, kMatcher))
      metric.values[matcher[1]] = Split(matcher[3], '|');
  }
  return metrics;
}

std::set<std::string> LabelsNamedIn(std::string_view expression) {
  static const std::regex kBy(R"((?:by|on)\s*\(([^)]*)\))");
  const std::string text(expression);
  std::set<std::string> labels;
  for (const std::smatch& match : Matches(text, kBy)) {
    for (std::string label : Split(match[1], ',')) {
      std::erase(label, ' ');
      labels.insert(label);
    }
  }
  return labels;
}

std::map<std::string, ScrapedMetric> ReadScrape(const std::string& text) {
  static const std::regex kSeries(R"(([a-z_]+)(\{(.*)\})? \S+)");
  static const std::regex kLabel(R"re((\w+)="([^"]*)")re");
  std::map<std::string, ScrapedMetric> metrics;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    std::smatch match;
    if (line.starts_with('#') || !std::regex_match(line, match, kSeries)) continue;
    ScrapedMetric& metric = metrics[match[1]];
    const std::string labels = match[3];
    for (const std::smatch& label : Matches(labels, kLabel))
      metric.labels[label[1]].insert(label[2]);
  }
  return metrics;
}

}  // namespace orbweave::deploy
