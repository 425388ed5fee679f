// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace orbweave::deploy {

/// What an expression of PromQL wants of one metric.
struct NamedMetric {
  std::string name{};                                        ///< as a scrape has it, with _bucket
  std::map<std::string, std::vector<std::string>> values{};  ///< that labels are compared with
};

/// The metrics of ours that an expression names.
[[nodiscard]] std::vector<NamedMetric> MetricsNamedIn(std::string_view expression);
/// The labels that it sums by.
[[nodiscard]] std::set<std::string> LabelsNamedIn(std::string_view expression);

/// The series of a scrape: name, and the values of each label.
struct ScrapedMetric {
  std::map<std::string, std::set<std::string>> labels{};
};
[[nodiscard]] std::map<std::string, ScrapedMetric> ReadScrape(const std::string& text);

}  // namespace orbweave::deploy
