// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/pairs_codec.h"

#include <algorithm>

#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"
#include "proto/codec/predicted_pose_message.h"

namespace orbweave {
namespace {

absl::StatusOr<std::vector<ImagePair>> PairsFrom(const std::string& bytes, const char* what) {
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<ImagePair> pairs, codec::Unpack<ImagePair>(bytes, what));
  const auto is_pair = [](const ImagePair& pair) { return pair.a < pair.b; };
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::Ascends(pairs) && std::ranges::all_of(pairs, is_pair),
                    what,
                    "pairs are not in order"));
  return pairs;
}

}  // namespace

absl::StatusOr<std::string> EncodePairCandidates(const PairCandidates& candidates) {
  v1::PairCandidates proto;
  proto.set_first(codec::Pack(candidates.first));
  proto.set_second(codec::Pack(candidates.second));
  proto.set_reserve(codec::Pack(candidates.reserve));
  return codec::Serialize(proto, "pair candidates", codec::Empty::kIsLegal);
}

absl::StatusOr<PairCandidates> DecodePairCandidates(std::string_view bytes) {
  constexpr char kWhat[] = "pair candidates";
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::PairCandidates proto,
                            codec::Parse<v1::PairCandidates>(bytes, kWhat, codec::Empty::kIsLegal));
  PairCandidates candidates;
  ORBWEAVE_ASSIGN_OR_RETURN(candidates.first, PairsFrom(proto.first(), kWhat));
  ORBWEAVE_ASSIGN_OR_RETURN(candidates.second, PairsFrom(proto.second(), kWhat));
  ORBWEAVE_ASSIGN_OR_RETURN(candidates.reserve, PairsFrom(proto.reserve(), kWhat));
  return candidates;
}

absl::StatusOr<std::string> EncodeMatchedPairs(const std::vector<MatchedPair>& pairs) {
  std::vector<ImagePair> names;
  std::vector<uint8_t> kinds;
  std::vector<uint32_t> moved;
  std::vector<double> evidence;
  std::vector<uint8_t> rungs;
  v1::MatchedPairs proto;
  for (const MatchedPair& pair : pairs) {
    names.push_back(pair.pair);
    kinds.push_back(static_cast<uint8_t>(pair.kind));
    moved.push_back(pair.num_moved);
    evidence.push_back(pair.log10_false_alarms);
    rungs.push_back(static_cast<uint8_t>(pair.rung));
    codec::ToProto(pair.b_from_a, proto.add_poses());
  }
  proto.set_pairs(codec::Pack(names));
  proto.set_kinds(codec::Pack(kinds));
  proto.set_num_moved(codec::Pack(moved));
  proto.set_log10_false_alarms(codec::Pack(evidence));
  proto.set_rungs(codec::Pack(rungs));
  return codec::Serialize(proto, "matched pairs", codec::Empty::kIsLegal);
}

absl::StatusOr<std::vector<MatchedPair>> DecodeMatchedPairs(std::string_view bytes) {
  constexpr char kWhat[] = "matched pairs";
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::MatchedPairs proto,
                            codec::Parse<v1::MatchedPairs>(bytes, kWhat, codec::Empty::kIsLegal));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto names, PairsFrom(proto.pairs(), kWhat));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto kinds,
                            codec::UnpackExactly<uint8_t>(proto.kinds(), names.size(), kWhat));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto moved,
                            codec::UnpackExactly<uint32_t>(proto.num_moved(), names.size(), kWhat));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto evidence,
      codec::UnpackExactly<double>(proto.log10_false_alarms(), names.size(), kWhat));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto rungs,
                            codec::UnpackExactly<uint8_t>(proto.rungs(), names.size(), kWhat));
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(std::ranges::all_of(rungs, [](uint8_t rung) { return rung < kNumMatchRungs; }),
                    kWhat,
                    "unknown rung"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      std::ranges::all_of(
          kinds, [](uint8_t kind) { return kind <= static_cast<uint8_t>(TwoViewKind::kPlanar); }),
      kWhat,
      "unknown kind"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      std::ranges::all_of(evidence, codec::IsNumber), kWhat, "evidence is no number"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      static_cast<size_t>(proto.poses_size()) == names.size(), kWhat, "not one pose for each"));
  std::vector<MatchedPair> pairs;
  for (size_t i = 0; i < names.size(); ++i) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Rigid3 pose,
                              codec::FromProto(proto.poses(static_cast<int>(i))));
    const auto kind = static_cast<TwoViewKind>(kinds[i]);
    ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
        !HasBaseline(kind) || codec::IsDirection(pose.translation), kWhat, "a pose leads nowhere"));
    pairs.push_back(
        {names[i], kind, moved[i], evidence[i], static_cast<MatchRung>(rungs[i]), pose});
  }
  return pairs;
}

absl::StatusOr<std::string> EncodeWiderPairs(const WiderPairs& wider) {
  v1::WiderPairs proto;
  proto.set_wants_facades(wider.wants_facades);
  proto.set_decisions(wider.decisions);
  proto.set_second(codec::Pack(wider.second));
  proto.set_reserve(codec::Pack(wider.reserve));
  proto.set_num_held_back(wider.num_held_back);
  proto.set_num_thin_images(wider.num_thin_images);
  std::vector<ImagePair> predicted;
  for (const PredictedPair& pair : wider.predicted) {
    predicted.push_back(pair.pair);
    codec::ToProto(pair.pose, proto.add_predicted_poses());
  }
  proto.set_predicted(codec::Pack(predicted));
  return codec::Serialize(proto, "wider pairs", codec::Empty::kIsLegal);
}

absl::StatusOr<WiderPairs> DecodeWiderPairs(std::string_view bytes) {
  constexpr char kWhat[] = "wider pairs";
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::WiderPairs proto,
                            codec::Parse<v1::WiderPairs>(bytes, kWhat, codec::Empty::kIsLegal));
  WiderPairs wider{.wants_facades = proto.wants_facades(),
                   .decisions = proto.decisions(),
                   .num_held_back = proto.num_held_back(),
                   .num_thin_images = proto.num_thin_images()};
  ORBWEAVE_ASSIGN_OR_RETURN(wider.second, PairsFrom(proto.second(), kWhat));
  ORBWEAVE_ASSIGN_OR_RETURN(wider.reserve, PairsFrom(proto.reserve(), kWhat));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto predicted, PairsFrom(proto.predicted(), kWhat));
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(static_cast<size_t>(proto.predicted_poses_size()) == predicted.size(),
                    kWhat,
                    "not one predicted pose for each"));
  for (size_t i = 0; i < predicted.size(); ++i) {
    ORBWEAVE_ASSIGN_OR_RETURN(const PredictedPose pose,
                              codec::FromProto(proto.predicted_poses(static_cast<int>(i))));
    wider.predicted.push_back({predicted[i], pose});
  }
  return wider;
}

}  // namespace orbweave
