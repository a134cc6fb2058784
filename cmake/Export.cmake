# find_package(berm) gives berm::sph: soil mechanics on particles, static, without the seepage stage.
# Installed with everything else; left out of the Debian package (component development).
include(CMakePackageConfigHelpers)
set(config "${CMAKE_CURRENT_BINARY_DIR}/export")
set(config_dir lib/cmake/berm)

foreach(module core meshes sph)
  set_target_properties(berm_${module} PROPERTIES EXPORT_NAME ${module})
  install(DIRECTORY ${module} DESTINATION include/berm COMPONENT development FILES_MATCHING PATTERN "*.h"
    PATTERN gmsh_session.h EXCLUDE PATTERN mesher.h EXCLUDE PATTERN mesh_file.h EXCLUDE)
endforeach()
install(TARGETS berm_core berm_meshes berm_sph EXPORT berm ARCHIVE DESTINATION lib COMPONENT development)
install(EXPORT berm NAMESPACE berm:: FILE berm-targets.cmake DESTINATION ${config_dir} COMPONENT development)

file(CONFIGURE OUTPUT "${config}/berm-config.cmake" @ONLY CONTENT [[
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(fmt)
find_dependency(OpenMP COMPONENTS CXX)
include("${CMAKE_CURRENT_LIST_DIR}/berm-targets.cmake")
]])
write_basic_package_version_file("${config}/berm-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${config}/berm-config.cmake" "${config}/berm-config-version.cmake"
  DESTINATION ${config_dir} COMPONENT development)
