# cmake -DONLY=... -P mistyped_dependency.cmake: a user of a module that does not exist.
set(ORBWEAVE_ONLY "${ONLY}")
include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/OrbweaveModule.cmake")
orbweave_have_modules(complete "test core/geometry" goemetry)
message(STATUS "complete: ${complete}")
