# METIS::METIS, the graph partitioner (Debian: libmetis-dev ships no CMake config).
find_path(ORBWEAVE_METIS_INCLUDE_DIR metis.h)
find_library(ORBWEAVE_METIS_LIBRARY metis)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MetisGraph REQUIRED_VARS ORBWEAVE_METIS_LIBRARY ORBWEAVE_METIS_INCLUDE_DIR)
if(MetisGraph_FOUND AND NOT TARGET METIS::METIS)
  add_library(METIS::METIS UNKNOWN IMPORTED)
  set_target_properties(METIS::METIS PROPERTIES
    IMPORTED_LOCATION "${ORBWEAVE_METIS_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${ORBWEAVE_METIS_INCLUDE_DIR}")
endif()
