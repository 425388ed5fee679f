// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/assign_drives.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace orbweave {
namespace {

/// Indices of images that are gone through one after another.
using Sequence = std::vector<size_t>;

std::string FolderOf(const std::string& name) { return name.substr(0, name.rfind('/') + 1); }

/// Whether one of these folders has a picture that was taken between two of another.
bool TimesOverlap(const std::map<std::string, Sequence>& folders, const ImageManifest& manifest) {
  std::vector<std::pair<double, double>> spans_s;
  for (const auto& [folder, images] : folders) {
    const auto time_s = [&](size_t i) { return *manifest.images[i].capture_time_s; };
    const auto [first, last] = std::ranges::minmax_element(images, {}, time_s);
    spans_s.emplace_back(time_s(*first), time_s(*last));
  }
  std::ranges::sort(spans_s);
  for (size_t i = 1; i < spans_s.size(); ++i) {
    if (spans_s[i].first < spans_s[i - 1].second) return true;
    spans_s[i].second = std::max(spans_s[i].second, spans_s[i - 1].second);
  }
  return false;
}

/// The images without a label, in the order in which they were taken as far as that is known.
std::vector<Sequence> Sequences(const Sequence& unlabelled, const ImageManifest& manifest) {
  const auto has_time = [&](size_t i) { return manifest.images[i].capture_time_s.has_value(); };
  if (!std::ranges::all_of(unlabelled, has_time)) return {unlabelled};
  std::map<std::string, Sequence> folders;
  for (const size_t i : unlabelled) folders[FolderOf(manifest.images[i].name)].push_back(i);
  std::vector<Sequence> sequences = {unlabelled};
  if (TimesOverlap(folders, manifest)) {
    sequences.clear();
    for (auto& [folder, images] : folders) sequences.push_back(std::move(images));
  }
  for (Sequence& sequence : sequences) {
    std::ranges::stable_sort(
        sequence, {}, [&](size_t i) { return *manifest.images[i].capture_time_s; });
  }
  return sequences;
}

/// Cuts a sequence at its pauses; appends to `groups`.
void CutAtPauses(const Sequence& sequence,
                 double gap_s,
                 const ImageManifest& manifest,
                 std::vector<Sequence>& groups) {
  std::optional<double> last_time_s;
  for (size_t k = 0; k < sequence.size(); ++k) {
    const std::optional<double>& time_s = manifest.images[sequence[k]].capture_time_s;
    const bool paused = time_s && last_time_s && std::abs(*time_s - *last_time_s) > gap_s;
    if (k == 0 || paused) groups.emplace_back();
    if (time_s) last_time_s = time_s;
    groups.back().push_back(sequence[k]);
  }
}

}  // namespace

void SetCaptureTimes(std::span<const IngestCandidate> candidates, ImageManifest& manifest) {
  const auto of_table = [](const IngestCandidate& candidate) {
    return candidate.row == nullptr ? std::nullopt : candidate.row->capture_time_s;
  };
  const auto of_header = [](const IngestCandidate& candidate) {
    return candidate.source->metadata.capture_time_s;
  };
  const auto has = [&](const auto& time_of) {
    return std::ranges::count_if(candidates, [&](const IngestCandidate& candidate) {
      return time_of(candidate).has_value();
    });
  };
  const bool by_table = has(of_table) > 0 && has(of_table) >= has(of_header);
  for (size_t i = 0; i < candidates.size(); ++i) {
    manifest.images[i].capture_time_s =
        by_table ? of_table(candidates[i]) : of_header(candidates[i]);
  }
}

void AssignDrives(std::span<const IngestCandidate> candidates,
                  double gap_s,
                  ImageManifest& manifest) {
  std::map<std::string, Sequence> labelled;
  Sequence unlabelled;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const GnssRow* row = candidates[i].row;
    (row != nullptr && row->drive ? labelled[*row->drive] : unlabelled).push_back(i);
  }
  std::vector<Sequence> groups;
  for (auto& [label, images] : labelled) groups.push_back(std::move(images));
  for (const Sequence& sequence : Sequences(unlabelled, manifest))
    CutAtPauses(sequence, gap_s, manifest, groups);
  std::ranges::sort(
      groups, {}, [](const Sequence& group) { return *std::ranges::min_element(group); });
  for (uint32_t drive = 0; drive < groups.size(); ++drive) {
    for (const size_t i : groups[drive]) manifest.images[i].drive = drive;
  }
}

}  // namespace orbweave
