# `cmake --install`: the program, and for find_package(Orbweave) the libraries of core, proto and stages as
# Orbweave::NAME with their headers. See examples/.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(ORBWEAVE_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Orbweave")
set(ORBWEAVE_HEADER_DIR "${CMAKE_INSTALL_INCLUDEDIR}/orbweave")

# orbweave_install_libraries(): to be called when all folders are added.
function(orbweave_install_libraries)
  get_property(modules GLOBAL PROPERTY ORBWEAVE_MODULES)
  set(installed "")
  foreach(module IN LISTS modules)
    get_target_property(folder ${module} SOURCE_DIR)
    file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${folder}")
    if(folder MATCHES "^(core/.*|proto|stages)$")
      string(REPLACE "orbweave_" "" name ${module})
      set_target_properties(${module} PROPERTIES EXPORT_NAME ${name})
      list(APPEND installed ${module})
    endif()
  endforeach()
  install(TARGETS ${installed} EXPORT OrbweaveTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(EXPORT OrbweaveTargets NAMESPACE Orbweave:: DESTINATION "${ORBWEAVE_PACKAGE_DIR}")
  foreach(folder core proto stages)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}" DESTINATION "${ORBWEAVE_HEADER_DIR}" FILES_MATCHING PATTERN "*.h")
  endforeach()
  install(DIRECTORY "${PROJECT_BINARY_DIR}/proto/orbweave" DESTINATION "${ORBWEAVE_HEADER_DIR}"
    FILES_MATCHING PATTERN "*.pb.h")
  configure_package_config_file(cmake/OrbweaveConfig.cmake.in "${PROJECT_BINARY_DIR}/OrbweaveConfig.cmake"
    INSTALL_DESTINATION "${ORBWEAVE_PACKAGE_DIR}")
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/OrbweaveConfigVersion.cmake" COMPATIBILITY ExactVersion)
  install(FILES "${PROJECT_BINARY_DIR}/OrbweaveConfig.cmake" "${PROJECT_BINARY_DIR}/OrbweaveConfigVersion.cmake"
    cmake/FindMetisGraph.cmake cmake/FindOpenCVParts.cmake DESTINATION "${ORBWEAVE_PACKAGE_DIR}")
  if(TARGET orbweave)
    install(TARGETS orbweave RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  endif()
endfunction()
