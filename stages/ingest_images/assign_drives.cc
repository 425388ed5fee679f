// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/assign_drives.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/scene/folder_of.h"
#include "core/scene/sequence_of_drive.h"
#include "stages/ingest_images/join_gnss_rows.h"

namespace orbweave {
namespace {

/// Images that are gone through one after another.
using Sequence = std::vector<ImageId>;

/// Per image of a folder, in order of names: of the table, if it has one.
using Labels = std::vector<std::optional<std::string>>;

/// Gives those between two of one label that label too, and as many at most before the first and
/// behind the last of all.
void LabelBetween(Labels& labels) {
  const auto is_labelled = [](const auto& label) { return label.has_value(); };
  const auto first = std::ranges::find_if(labels, is_labelled);
  if (first == labels.end()) return;
  std::ptrdiff_t longest = 0;
  auto last = first;
  for (auto next = first; next != labels.end(); ++next) {
    if (!next->has_value()) continue;
    if (*next == *last) {
      longest = std::max(longest, next - last - 1);
      std::fill(last, next, *last);
    }
    last = next;
  }
  if (first - labels.begin() <= longest) std::fill(labels.begin(), first, *first);
  if (labels.end() - last - 1 <= longest) std::fill(last, labels.end(), *last);
}

/// Per image.
Labels LabelsOf(std::span<const IngestCandidate> candidates, const ImageManifest& manifest) {
  std::map<std::string_view, std::vector<size_t>> folders;
  for (size_t i = 0; i < candidates.size(); ++i)
    folders[FolderOf(manifest.images[i].name)].push_back(i);
  Labels labels(candidates.size());
  for (const auto& [folder, images] : folders) {
    Labels of_folder;
    for (const size_t i : images) {
      const GnssRow* row = candidates[i].row;
      of_folder.push_back(row == nullptr ? std::nullopt : row->drive);
    }
    LabelBetween(of_folder);
    for (size_t k = 0; k < images.size(); ++k) labels[images[k]] = of_folder[k];
  }
  return labels;
}

/// Whether one of these folders has a picture that was taken between two of another.
bool TimesOverlap(const std::map<std::string_view, Sequence>& folders,
                  const ImageManifest& manifest) {
  std::vector<std::pair<double, double>> spans_s;
  for (const auto& [folder, images] : folders) {
    const Sequence timed = TimedAmong(manifest, images);
    if (timed.empty()) continue;
    const auto time_s = [&](ImageId id) { return *manifest.At(id).capture_time_s; };
    const auto [first, last] = std::ranges::minmax_element(timed, {}, time_s);
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
std::vector<TimeOrder> OrdersOf(const Sequence& unlabelled, const ImageManifest& manifest) {
  std::map<std::string_view, Sequence> folders;
  for (const ImageId id : unlabelled) folders[FolderOf(manifest.At(id).name)].push_back(id);
  if (!TimesOverlap(folders, manifest)) return {OrderByTime(manifest, unlabelled)};
  std::vector<TimeOrder> orders;
  for (const auto& [folder, images] : folders) orders.push_back(OrderByTime(manifest, images));
  return orders;
}

/// Cuts a sequence at its pauses; appends to `groups`.
void CutAtPauses(const Sequence& sequence,
                 double gap_s,
                 const ImageManifest& manifest,
                 std::vector<Sequence>& groups) {
  std::optional<double> last_time_s;
  for (size_t k = 0; k < sequence.size(); ++k) {
    const std::optional<double>& time_s = manifest.At(sequence[k]).capture_time_s;
    const bool paused = time_s && last_time_s && std::abs(*time_s - *last_time_s) > gap_s;
    if (k == 0 || paused) groups.emplace_back();
    if (time_s) last_time_s = time_s;
    groups.back().push_back(sequence[k]);
  }
}

void WarnOfUnsure(std::vector<ImageId> unsure, ImageManifest& manifest) {
  std::ranges::sort(unsure);
  std::vector<std::string> names;
  for (const ImageId id : unsure) names.push_back(manifest.At(id).name);
  WarnOfNames(names,
              "image has no capture time, and the times of others do not follow names there; it "
              "is taken to follow the one before it by name",
              "images have no capture time, and the times of others do not follow names there; "
              "they are taken to follow the ones before them by name",
              manifest);
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
  const Labels labels = LabelsOf(candidates, manifest);
  std::map<std::string, Sequence> labelled;
  Sequence unlabelled;
  for (size_t i = 0; i < candidates.size(); ++i)
    (labels[i] ? labelled[*labels[i]] : unlabelled).push_back(manifest.images[i].id);
  std::vector<Sequence> groups;
  Sequence unsure;
  const auto order_of_group = [&](const TimeOrder& order) {
    unsure.insert(unsure.end(), order.unsure.begin(), order.unsure.end());
    return order.sequence;
  };
  for (const auto& [label, images] : labelled)
    groups.push_back(order_of_group(OrderByTime(manifest, images)));
  for (const TimeOrder& order : OrdersOf(unlabelled, manifest))
    CutAtPauses(order_of_group(order), gap_s, manifest, groups);
  std::ranges::sort(
      groups, {}, [](const Sequence& group) { return *std::ranges::min_element(group); });
  for (uint32_t drive = 0; drive < groups.size(); ++drive) {
    for (const ImageId id : groups[drive]) manifest.images[id.value].drive = drive;
  }
  WarnOfUnsure(std::move(unsure), manifest);
}

}  // namespace orbweave
