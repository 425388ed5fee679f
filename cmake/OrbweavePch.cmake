# Precompiled headers: third-party and standard headers that most units include, parsed once instead of
# a few hundred times. Never a header of the house, so that a change of one rebuilds
# only who includes it. One per kind of code, as flags must be equal: libraries, programs, tests.
# A unit still includes what it uses: the preset `tidy` compiles without (ORBWEAVE_PCH=OFF).
option(ORBWEAVE_PCH "Precompile third-party and standard headers" ON)

set(ORBWEAVE_PCH_HEADERS
  <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <cstdio> <filesystem> <fstream>
  <functional> <limits> <map> <memory> <mutex> <numbers> <numeric> <optional> <set> <span> <sstream>
  <stop_token> <string> <string_view> <thread> <tuple> <unordered_map> <utility> <vector>
  <absl/container/inlined_vector.h> <absl/status/status.h> <absl/status/statusor.h> <absl/strings/str_cat.h>
  <absl/strings/str_format.h>
  <Eigen/Core> <Eigen/Geometry>)
set(ORBWEAVE_PCH_LIBS Eigen3::Eigen absl::inlined_vector absl::status absl::statusor absl::strings absl::str_format)

# orbweave_pch_owner(KIND LIBRARY|EXECUTABLE LIBS... HEADERS...): the target orbweave_pch_KIND, whose header others use.
function(orbweave_pch_owner kind form)
  cmake_parse_arguments(P "" "" "LIBS;HEADERS" ${ARGN})
  set(unit "${PROJECT_BINARY_DIR}/pch/${kind}.cc")
  file(CONFIGURE OUTPUT "${unit}" CONTENT "int main() { return 0; }\n")
  if(form STREQUAL "LIBRARY")
    add_library(orbweave_pch_${kind} OBJECT "${unit}")
  else()
    add_executable(orbweave_pch_${kind} "${unit}")
  endif()
  target_link_libraries(orbweave_pch_${kind} PRIVATE ${ORBWEAVE_PCH_LIBS} ${P_LIBS} orbweave_warnings)
  target_precompile_headers(orbweave_pch_${kind} PRIVATE ${ORBWEAVE_PCH_HEADERS} ${P_HEADERS})
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")  # ccache knows a header by its bytes
    target_compile_options(orbweave_pch_${kind} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  endif()
endfunction()

# orbweave_use_pch(TARGET library|program|test)
function(orbweave_use_pch target kind)
  if(TARGET orbweave_pch_${kind})
    target_precompile_headers(${target} REUSE_FROM orbweave_pch_${kind})
  endif()
endfunction()

if(ORBWEAVE_PCH)
  # With them g++ 12 raises more of its false alarms on std::string (GCC bug 105651); a build without has all warnings.
  target_compile_options(orbweave_warnings INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread>)
  add_compile_options(-pthread)  # a flag that some packages bring and that all units must then have
  orbweave_pch_owner(library LIBRARY)
  orbweave_pch_owner(program EXECUTABLE)
  if(ORBWEAVE_TESTS)
    orbweave_pch_owner(test EXECUTABLE LIBS GTest::gmock HEADERS <gmock/gmock.h> <gtest/gtest.h>)
    target_compile_options(orbweave_pch_test PRIVATE ${ORBWEAVE_TEST_OPTIONS})
  endif()
endif()
