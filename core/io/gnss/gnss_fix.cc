// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/gnss/gnss_fix.h"

#include <array>
#include <string>
#include <utility>

#include "core/io/text_fields.h"

namespace orbweave {
namespace {

constexpr std::array<std::pair<std::string_view, GnssFix>, 40> kWords = {{
    {"0", GnssFix::kNone},
    {"none", GnssFix::kNone},
    {"no", GnssFix::kNone},
    {"nofix", GnssFix::kNone},
    {"invalid", GnssFix::kNone},
    {"6", GnssFix::kNone},
    {"estimated", GnssFix::kNone},
    {"deadreckoning", GnssFix::kNone},
    {"dr", GnssFix::kNone},
    {"7", GnssFix::kNone},
    {"manual", GnssFix::kNone},
    {"8", GnssFix::kNone},
    {"simulation", GnssFix::kNone},
    {"simulated", GnssFix::kNone},
    {"1", GnssFix::kAutonomous},
    {"autonomous", GnssFix::kAutonomous},
    {"single", GnssFix::kAutonomous},
    {"standalone", GnssFix::kAutonomous},
    {"gps", GnssFix::kAutonomous},
    {"gnss", GnssFix::kAutonomous},
    {"sps", GnssFix::kAutonomous},
    {"2d", GnssFix::kAutonomous},
    {"3d", GnssFix::kAutonomous},
    {"2dfix", GnssFix::kAutonomous},
    {"3dfix", GnssFix::kAutonomous},
    {"3", GnssFix::kAutonomous},  // PPS: another signal, no corrections
    {"pps", GnssFix::kAutonomous},
    {"2", GnssFix::kDifferential},
    {"dgps", GnssFix::kDifferential},
    {"dgnss", GnssFix::kDifferential},
    {"differential", GnssFix::kDifferential},
    {"sbas", GnssFix::kDifferential},
    {"5", GnssFix::kRtkFloat},
    {"float", GnssFix::kRtkFloat},
    {"rtkfloat", GnssFix::kRtkFloat},
    {"floatrtk", GnssFix::kRtkFloat},
    {"4", GnssFix::kRtkFixed},
    {"fixed", GnssFix::kRtkFixed},
    {"rtkfixed", GnssFix::kRtkFixed},
    {"rtkfix", GnssFix::kRtkFixed},
}};

}  // namespace

std::optional<GnssFix> GnssFixFromText(std::string_view text) {
  std::string word;
  for (const char c : LowerText(text)) {
    if (c != ' ' && c != '_' && c != '-') word += c;
  }
  for (const auto& [known, fix] : kWords) {
    if (word == known) return fix;
  }
  return std::nullopt;
}

std::optional<double> SigmaOfFix(GnssFix fix) {
  switch (fix) {
    // Receivers are sold with 1 cm + 1 ppm of the way to the base; the place of the antenna above
    // the camera is known no better than by some centimetres.
    case GnssFix::kRtkFixed:
      return 0.05;
    // Ambiguities as real numbers converge from metres to decimetres.
    case GnssFix::kRtkFloat:
      return 0.5;
    // Performance standards of WAAS and EGNOS: 3 m horizontally for 95 %, 2.45 sigmas of one
    // axis, under an open sky.
    case GnssFix::kDifferential:
      return 1.5;
    case GnssFix::kAutonomous:
    case GnssFix::kNone:
      break;
  }
  return std::nullopt;
}

}  // namespace orbweave
