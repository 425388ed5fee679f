// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/cluster_colors.h"

#include <set>

#include "absl/strings/str_cat.h"

namespace orbweave {

std::string ColorClass(int color) {
  if (color < 0) return "kn";
  const bool is_hollow = color % kMapLooks >= kMapColors;
  return absl::StrCat("k", color % kMapColors, is_hollow ? " hollow" : "");
}

std::vector<int> ColorsOfClusters(const JobReport& report) {
  std::vector<std::set<uint32_t>> neighbours(report.clusters.size());
  for (const ReportSeam& seam : report.seams) {
    if (seam.cluster_a >= neighbours.size() || seam.cluster_b >= neighbours.size()) continue;
    neighbours[seam.cluster_a].insert(seam.cluster_b);
    neighbours[seam.cluster_b].insert(seam.cluster_a);
  }
  std::vector<int> colors(neighbours.size(), -1);
  for (size_t cluster = 0; cluster < colors.size(); ++cluster) {
    std::set<int> taken;
    for (const uint32_t neighbour : neighbours[cluster]) taken.insert(colors[neighbour]);
    const int first = static_cast<int>(cluster % kMapColors);
    colors[cluster] = first;
    for (int step = 0; step < kMapColors; ++step) {
      const int color = (first + step) % kMapColors;
      if (taken.contains(color)) continue;
      colors[cluster] = color;
      break;
    }
  }
  return colors;
}

}  // namespace orbweave
