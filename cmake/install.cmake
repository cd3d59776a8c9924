# find_package(onset CONFIG) and pkg-config for the installed library. Components, which packages are made of: library, what
# programs run with; development, what they are built with; tools; licence.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(onset_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/onset)

install(TARGETS onset EXPORT onsetTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/onset DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING PATTERN "*.hpp")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/onset COMPONENT licence)
install(EXPORT onsetTargets NAMESPACE onset:: DESTINATION ${onset_cmake_dir} COMPONENT development)

# TBB, or the system's threads, are private: only who links the static library has to find them.
set(onset_needs "")
set(onset_pc_requires "eigen3")
set(onset_pc_libs "")
set(onset_pc_cflags "")
if(onset_type STREQUAL "SHARED_LIBRARY")
  set(onset_pc_cflags " -DONSET_SHARED")
elseif(ONSET_THREADS STREQUAL "TBB")
  set(onset_needs TBB)
  string(APPEND onset_pc_requires ", tbb")
else()
  set(onset_needs Threads)
  set(onset_pc_libs " -pthread")
endif()

configure_package_config_file(cmake/onsetConfig.cmake.in onsetConfig.cmake INSTALL_DESTINATION ${onset_cmake_dir})
# 0.x: every minor version may change the interface.
write_basic_package_version_file(onsetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/onsetConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/onsetConfigVersion.cmake
        DESTINATION ${onset_cmake_dir} COMPONENT development)

# The prefix is worked out from where onset.pc lies, so that the installed tree can be moved.
file(RELATIVE_PATH onset_pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/onset.pc.in onset.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/onset.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

if(ONSET_DEB)
  include(packaging/deb/packages.cmake)
endif()
