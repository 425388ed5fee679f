# CHOLMOD::CHOLMOD, sparse Cholesky of SuiteSparse (Debian 12 ships no CMake config for it).
find_path(ORBWEAVE_CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(ORBWEAVE_CHOLMOD_LIBRARY cholmod)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Cholmod REQUIRED_VARS ORBWEAVE_CHOLMOD_LIBRARY ORBWEAVE_CHOLMOD_INCLUDE_DIR)
if(Cholmod_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(CHOLMOD::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${ORBWEAVE_CHOLMOD_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${ORBWEAVE_CHOLMOD_INCLUDE_DIR}")
endif()
