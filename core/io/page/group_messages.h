// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// Messages of one kind, by their places in the list.
struct MessageGroup {
  std::vector<size_t> members{};  ///< ascending, not empty
  bool same_words = true;         ///< all say exactly the same
};

/// Messages that differ in numbers and file names alone are of one kind: "28 of 40 points agree"
/// and "3 of 20 points agree". Groups in order of their first members.
[[nodiscard]] std::vector<MessageGroup> GroupByKind(std::span<const std::string> messages);

/// A line per kind: the first message, and how many more there are like it.
[[nodiscard]] std::vector<std::string> CountedLines(std::span<const std::string> messages);

/// A line per kind of reason: "b.jpg: it is truncated", "30 images: no verified matches, first
/// a.jpg"; where the reasons differ in numbers "30 images, such as a.jpg: 3 of 20 points agree".
[[nodiscard]] std::vector<std::string> CountedLines(std::span<const Exclusion> images);

/// The line of the reason that most of them share; empty without images.
[[nodiscard]] std::string CommonestLine(std::span<const Exclusion> images);

}  // namespace orbweave
