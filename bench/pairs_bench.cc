// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// What matching whole pairs costs, and what of it, on one thread:
///
///   bench_pairs IMAGES [--masks MASKS] [--reach 100] [--repeat 3] [--pace] [--steps]
///               [--set match.key=value] [--set two_view.key=value] [--set extract.key=value]
///
/// IMAGES is a folder of panoramas, MASKS one of masks of the same names (PNG, white: ignored).
/// Features are extracted once; then every two panoramas that are `reach` apart by name at most are
/// matched as stages/match_images does, the whole set `repeat` times, of which the fastest counts.
/// --steps: each step is timed by itself as well, on the same pairs and what the whole found of
/// them. --pace: also what OpenCV's SIFT takes for the first panorama, to compare machines by.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/estimators/estimate_two_view.h"
#include "core/estimators/find_rival_direction.h"
#include "core/estimators/grow_two_view.h"
#include "core/features/extract_features.h"
#include "core/features/growing_nearest.h"
#include "core/features/match_against_decoys.h"
#include "core/features/match_descriptors.h"
#include "core/io/file.h"
#include "stages/match_images/match_image_pair.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kSeed = 1;

struct Arguments {
  std::string images{};
  std::string masks{};
  size_t reach = 100;
  int repeat = 3;
  bool pace = false;
  bool steps = false;
  ExtractOptions extract{};
  MatchOptions match{};
  TwoViewOptions two_view{};
};

[[noreturn]] void Fail(const std::string& message) {
  std::fprintf(stderr, "bench_pairs: %s\n", message.c_str());
  std::exit(2);
}

template <typename T>
T Take(absl::StatusOr<T> value) {
  if (!value.ok()) Fail(std::string(value.status().message()));
  return *std::move(value);
}

double CpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// CPU seconds of the fastest of some runs.
double Fastest(int repeat, const std::function<void()>& run) {
  double fastest_s = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeat; ++k) {
    const double before_s = CpuSeconds();
    run();
    fastest_s = std::min(fastest_s, CpuSeconds() - before_s);
  }
  return fastest_s;
}

void SetAny(Arguments& arguments, const std::string& setting) {
  const size_t dot = setting.find('.');
  const size_t equals = setting.find('=');
  if (dot == std::string::npos || equals == std::string::npos || dot > equals)
    Fail("--set takes SECTION.KEY=VALUE, not " + setting);
  const std::string section = setting.substr(0, dot);
  const std::string key = setting.substr(dot + 1, equals - dot - 1);
  const std::string value = setting.substr(equals + 1);
  absl::Status status = absl::NotFoundError("--set knows match, two_view and extract");
  if (section == "match") status = SetOption(arguments.match, key, value);
  if (section == "two_view") status = SetOption(arguments.two_view, key, value);
  if (section == "extract") status = SetOption(arguments.extract, key, value);
  if (!status.ok()) Fail(std::string(status.message()));
}

Arguments Parse(int count, char** values) {
  Arguments arguments;
  for (int k = 1; k < count; ++k) {
    const std::string name = values[k];
    if (name == "--pace") {
      arguments.pace = true;
    } else if (name == "--steps") {
      arguments.steps = true;
    } else if (!name.starts_with("--")) {
      arguments.images = name;
    } else {
      if (++k == count) Fail(name + " needs a value");
      const std::string value = values[k];
      if (name == "--masks") {
        arguments.masks = value;
      } else if (name == "--reach") {
        arguments.reach = std::stoul(value);
      } else if (name == "--repeat") {
        arguments.repeat = std::stoi(value);
      } else if (name == "--set") {
        SetAny(arguments, value);
      } else {
        Fail("unknown argument " + name);
      }
    }
  }
  if (arguments.images.empty()) Fail("needs a folder of panoramas");
  return arguments;
}

std::vector<fs::path> FilesOf(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
  if (files.empty()) Fail("no panoramas in " + folder);
  std::ranges::sort(files);
  return files;
}

class Bench {
 public:
  explicit Bench(const Arguments& arguments) : arguments_(arguments) {
    const std::vector<fs::path> files = FilesOf(arguments.images);
    if (arguments.pace) PrintPace(files.front());
    const double before_s = CpuSeconds();
    for (const fs::path& file : files) sides_.emplace_back(Extract(file, arguments_.extract));
    const double cpu_s = CpuSeconds() - before_s;
    std::printf("%zu panoramas, features in %.0f ms each\n",
                sides_.size(),
                1e3 * cpu_s / static_cast<double>(sides_.size()));
    for (uint32_t a = 0; a < sides_.size(); ++a) {
      for (uint32_t b = a + 1; b < sides_.size() && b <= a + arguments_.reach; ++b)
        pairs_.push_back({ImageId(a), ImageId(b)});
    }
    if (pairs_.empty()) Fail("no two panoramas to match");
  }

  void Run() {
    const double whole_s = Fastest(arguments_.repeat, [&] { MatchAll(); });
    Print("whole pairs", pairs_.size(), whole_s);
    for (const auto& [rung, name] : EnumNames<MatchRung>::kNames) PrintRung(rung, name);
    if (arguments_.steps) TimeSteps();
  }

 private:
  using Pairs = std::vector<ImagePair>;
  using Geometries = std::vector<TwoViewGeometry>;

  [[nodiscard]] Features Extract(const fs::path& file, const ExtractOptions& options) const {
    const std::string image = Take(ReadFile(file.string()));
    const fs::path mask_file =
        fs::path(arguments_.masks) / fs::path(file.filename()).replace_extension(".png");
    std::string mask;
    if (!arguments_.masks.empty() && fs::exists(mask_file))
      mask = Take(ReadFile(mask_file.string()));
    return Take(ExtractFeatures(
        {.name = file.native(), .encoded_image = image, .encoded_mask = mask}, options, {}));
  }

  void PrintPace(const fs::path& file) const {
    ExtractOptions options;
    options.detector = SiftDetector::kOpencv;
    const double pace_s = Fastest(1, [&] { (void)Extract(file, options); });
    std::printf("OpenCV's SIFT, first panorama: %.2f s\n", pace_s);
  }

  [[nodiscard]] const PairSide& A(const ImagePair& pair) const { return sides_[pair.a.value]; }
  [[nodiscard]] const PairSide& B(const ImagePair& pair) const { return sides_[pair.b.value]; }

  [[nodiscard]] double MaxErrorRad(const ImagePair& pair) const {
    return std::max(A(pair).features.camera.AngleFromPixels(arguments_.two_view.max_error_px),
                    B(pair).features.camera.AngleFromPixels(arguments_.two_view.max_error_px));
  }

  void MatchAll() {
    found_.clear();
    took_s_.clear();
    for (const ImagePair& pair : pairs_) {
      const double before_s = CpuSeconds();
      found_.push_back(Take(MatchImagePair(
          pair, A(pair), B(pair), {}, arguments_.match, arguments_.two_view, {.seed = kSeed})));
      took_s_.push_back(CpuSeconds() - before_s);
    }
  }

  static void Print(const std::string& what, size_t pairs, double cpu_s) {
    std::printf("%-34s %5zu pairs %8.3f CPU s %8.2f ms each\n",
                what.c_str(),
                pairs,
                cpu_s,
                1e3 * cpu_s / static_cast<double>(std::max<size_t>(1, pairs)));
  }

  /// Of the last run; pairs without a geometry stand at `given`, which nothing else is here.
  void PrintRung(MatchRung rung, std::string_view name) const {
    size_t pairs = 0;
    size_t inliers = 0;
    double cpu_s = 0.0;
    for (size_t k = 0; k < found_.size(); ++k) {
      if (found_[k].rung != rung) continue;
      ++pairs;
      inliers += found_[k].inliers.size();
      cpu_s += took_s_[k];
    }
    if (pairs == 0) return;
    const std::string what = rung == MatchRung::kGiven ? "none" : std::string(name);
    Print("  " + what + ", " + std::to_string(inliers) + " inliers", pairs, cpu_s);
  }

  void TimeSteps() {
    std::vector<size_t> all;
    std::vector<size_t> posed;
    for (size_t k = 0; k < found_.size(); ++k) {
      all.push_back(k);
      if (!found_[k].b_from_a.translation.isZero()) posed.push_back(k);
    }
    const auto time = [&](const char* what, const std::vector<size_t>& pairs, const auto& step) {
      const double cpu_s = Fastest(arguments_.repeat, [&] { std::ranges::for_each(pairs, step); });
      Print(what, pairs.size(), cpu_s);
    };
    const auto first = static_cast<size_t>(arguments_.match.largest_first);
    std::vector<std::vector<FeatureMatch>> putative(pairs_.size());
    const auto nearest = [&](size_t k, size_t count) {
      GrowingNearest growing(A(pairs_[k]), B(pairs_[k]));
      growing.GrowTo(count);
      putative[k] = AcceptNearest(growing.Nearest(), arguments_.match);
    };
    std::printf("steps by themselves\n");
    time("  nearest of all", all, [&](size_t k) {
      nearest(k, std::max(A(pairs_[k]).features.size(), B(pairs_[k]).features.size()));
    });
    time("  geometry of these", all, [&](size_t k) { Verify(pairs_[k], putative[k]); });
    time("  nearest of the largest", all, [&](size_t k) { nearest(k, first); });
    time("  geometry of these", all, [&](size_t k) { Verify(pairs_[k], putative[k]); });
    time("  search for another direction", posed, [&](size_t k) {
      (void)FindRivalDirection(A(pairs_[k]).bearings,
                               B(pairs_[k]).bearings,
                               putative[k],
                               found_[k],
                               MaxErrorRad(pairs_[k]),
                               kSeed);
    });
    std::vector<std::vector<FeatureMatch>> predicted(pairs_.size());
    time("  along the planes, with decoys", posed, [&](size_t k) {
      predicted[k] = MatchAgainstDecoys(A(pairs_[k]),
                                        B(pairs_[k]),
                                        found_[k].b_from_a,
                                        MaxErrorRad(pairs_[k]),
                                        nullptr,
                                        std::nullopt,
                                        arguments_.match)
                         .matches;
    });
    time("  pose of what these find", posed, [&](size_t k) {
      (void)GrowTwoView(found_[k],
                        A(pairs_[k]).bearings,
                        B(pairs_[k]).bearings,
                        predicted[k],
                        MaxErrorRad(pairs_[k]),
                        kSeed);
    });
  }

  void Verify(const ImagePair& pair, const std::vector<FeatureMatch>& matches) const {
    (void)Take(EstimateTwoView(pair,
                               A(pair).bearings,
                               B(pair).bearings,
                               matches,
                               MaxErrorRad(pair),
                               arguments_.two_view,
                               {.seed = kSeed}));
  }

  Arguments arguments_;
  std::vector<PairSide> sides_{};
  Pairs pairs_{};
  Geometries found_{};
  std::vector<double> took_s_{};
};

}  // namespace
}  // namespace orbweave

int main(int count, char** values) {
  orbweave::Bench(orbweave::Parse(count, values)).Run();
  return 0;
}
