// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/format_dense.h"

#include "absl/strings/str_format.h"
#include "core/io/printable_text.h"

namespace orbweave {

std::string FormatDense(const DenseReport& report, const std::string& folder) {
  std::string text = absl::StrFormat(
      "%d points on %d tiles from %d panoramas (%.0f %% of their sphere checked), %.0f s\n",
      report.num_points,
      report.tiles.size(),
      report.maps.size(),
      100.0 * report.Coverage(),
      report.elapsed_s);
  for (size_t i = 0; i < report.omitted.size() && i < 5; ++i)
    text += absl::StrFormat("without depth: %s: %s\n",
                            PrintableText(report.omitted[i].name),
                            PrintableText(report.omitted[i].reason));
  if (report.omitted.size() > 5)
    text += absl::StrFormat("and %d more, in %s/report.json\n", report.omitted.size() - 5, folder);
  return text + absl::StrFormat("%s/report.html, cloud.las, tiles/*.ply, from_above.png\n", folder);
}

}  // namespace orbweave
