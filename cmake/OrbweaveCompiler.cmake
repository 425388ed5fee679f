# Language, warnings, sanitizers. Binaries run on any CPU of the architecture: no -march=native;
# faster instruction sets are chosen at run time inside single functions.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(ORBWEAVE_CCACHE ccache)
if(ORBWEAVE_CCACHE)
  # What ccache overlooks to take precompiled headers (OrbweavePch.cmake); no source of the house says __TIME__.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env "CCACHE_SLOPPINESS=pch_defines,time_macros" "${ORBWEAVE_CCACHE}")
endif()

add_library(orbweave_warnings INTERFACE)
target_compile_options(orbweave_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -Wcast-qual -Wformat=2 -Wimplicit-fallthrough
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # false alarms of g++ 12 on std::string (GCC bug 105651)
if(ORBWEAVE_WARNINGS_AS_ERRORS)
  target_compile_options(orbweave_warnings INTERFACE -Werror)
endif()

# The same source gives the same bits: no contraction of a*b+c that depends on the call site.
add_compile_options(-ffp-contract=off)
# g++ tidies its memory up after every 100 MB and more, which takes a tenth to a fifth of the time of a file that needs
# 300 to 900 MB anyhow: it first does beyond one GB.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)

# The code of tests is optimised little: assertions are long to compile and quick to run. What they test is
# in libraries, which are optimised as users have them.
set(ORBWEAVE_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)

if(ORBWEAVE_SANITIZE)
  add_compile_options(-fsanitize=${ORBWEAVE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${ORBWEAVE_SANITIZE})
  # Where the kernel scatters addresses widely (vm.mmap_rnd_bits above 28) the sanitizers of g++ 12 find the
  # place of their shadow memory taken: tests run without scattering, unless that is forbidden, as in containers.
  execute_process(COMMAND setarch -R true RESULT_VARIABLE refused OUTPUT_QUIET ERROR_QUIET)
  if(refused STREQUAL "0")
    set(CMAKE_CROSSCOMPILING_EMULATOR setarch -R)
  endif()
endif()
