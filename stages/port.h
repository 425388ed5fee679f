// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/status.h"
#include "core/pipeline/job_plan.h"

/// Ports: what stages read and leave, by name and type. The same types stand for both ends, so that
/// a plan is wired by copying what one stage leaves into what another reads, and only what has the
/// same type can be copied. A port has no default where it is read: forgetting one does not
/// compile.

namespace orbweave {

/// How a T becomes bytes and back. A specialisation has
///
///   static constexpr std::string_view kName = "image_manifest";  // as of its fuzz target
///   static constexpr auto Encode = EncodeImageManifest;
///   static constexpr auto Decode = DecodeImageManifest;
template <typename T>
struct Codec;

/// One T: of a job, or what the only part of a stage leaves.
template <typename T>
struct One {
  InputRule from;
};

/// A T of each part of a stage, in part order; who reads this gets their digests.
template <typename T>
struct EachPart {
  InputRule from;
};

/// The same of all outputs of each part, interleaved: the First and the Second of the first part,
/// those of the next one.
template <typename First, typename Second>
struct Interleaved {
  InputRule from;
};

/// Recipes: who leaves them decides how many parts a stage has that reads them, and each of its
/// parts reads one. In a job, a list of them.
template <typename T>
struct Parts {
  InputRule from;
};

/// What the port says of the loop's round before. In the first round: an empty list, or T{}.
template <typename Port>
struct RoundBefore {
  explicit RoundBefore(Port port) : from(std::move(port.from)) {}
  InputRule from;
};

/// Both outputs of all parts, where a stage has these two and no others.
template <typename First, typename Second>
Interleaved<First, Second> Interleave(const EachPart<First>& first,
                                      const EachPart<Second>& second) {
  ORBWEAVE_CHECK(first.from.stage == second.from.stage && first.from.index == 0 &&
                 second.from.index == 1);
  return {{InputRule::Kind::kAllOutputs, first.from.stage, 0}};
}

/// Digests of interleaved outputs, apart again.
struct InterleavedDigests {
  std::vector<Digest> first{};
  std::vector<Digest> second{};
};

/// InvalidArgument: the last part left only one.
inline absl::StatusOr<InterleavedDigests> SplitInterleaved(const std::vector<Digest>& digests) {
  if (digests.size() % 2 != 0)
    return absl::InvalidArgumentError("a list of two outputs per part lacks the last one");
  InterleavedDigests split;
  for (size_t i = 0; i < digests.size(); i += 2) {
    split.first.push_back(digests[i]);
    split.second.push_back(digests[i + 1]);
  }
  return split;
}

/// What a port is, as data.
struct PortInfo {
  std::string_view name{};
  InputRule::Kind kind{};
  std::vector<std::string_view> types{};  ///< names of codecs; two where interleaved
  bool of_round_before = false;
};

namespace internal {

template <typename T>
PortInfo InfoOf(std::string_view name, const One<T>*) {
  return {name, InputRule::Kind::kOutput, {Codec<T>::kName}};
}
template <typename T>
PortInfo InfoOf(std::string_view name, const EachPart<T>*) {
  return {name, InputRule::Kind::kCollection, {Codec<T>::kName}};
}
template <typename A, typename B>
PortInfo InfoOf(std::string_view name, const Interleaved<A, B>*) {
  return {name, InputRule::Kind::kAllOutputs, {Codec<A>::kName, Codec<B>::kName}};
}
template <typename T>
PortInfo InfoOf(std::string_view name, const Parts<T>*) {
  return {name, InputRule::Kind::kRecipe, {Codec<T>::kName}};
}
template <typename Port>
PortInfo InfoOf(std::string_view name, const RoundBefore<Port>*) {
  PortInfo info = InfoOf(name, static_cast<const Port*>(nullptr));
  info.of_round_before = true;
  return info;
}

template <typename T>
inline constexpr bool kIsParts = false;
template <typename T>
inline constexpr bool kIsParts<Parts<T>> = true;

}  // namespace internal

/// Ports of anything with `static VisitPorts(visit)`, which calls visit("name", &Struct::port) for
/// each of them in the order in which tasks list their digests.
template <typename Struct>
std::vector<PortInfo> PortsOf() {
  std::vector<PortInfo> infos;
  Struct::VisitPorts([&]<typename Port>(std::string_view name, Port Struct::*) {
    infos.push_back(internal::InfoOf(name, static_cast<const Port*>(nullptr)));
  });
  return infos;
}

/// The number of a port in the order of VisitPorts. Recipes that are left are not counted: they are
/// no outputs. CHECK: it is visited.
template <typename Struct, typename Port>
uint32_t IndexOf(Port Struct::*port, bool counts_recipes) {
  uint32_t next = 0;
  uint32_t found = std::numeric_limits<uint32_t>::max();
  Struct::VisitPorts([&]<typename Other>(std::string_view, Other Struct::*other) {
    if constexpr (std::same_as<Other, Port>) {
      if (other == port) found = next;
    }
    if (counts_recipes || !internal::kIsParts<Other>) ++next;
  });
  ORBWEAVE_CHECK(found != std::numeric_limits<uint32_t>::max());
  return found;
}

}  // namespace orbweave
