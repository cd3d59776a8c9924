# The source is the archive of a release where its hash stands here, and until then the clone that this port lies in:
#   vcpkg install onset --overlay-ports=<clone>/packaging/vcpkg
set(ONSET_ARCHIVE "https://git.example/onset/archive/v${VERSION}.tar.gz")
set(ONSET_SHA512 "")

if(ONSET_SHA512)
  vcpkg_download_distfile(archive URLS "${ONSET_ARCHIVE}" FILENAME "onset-${VERSION}.tar.gz" SHA512 "${ONSET_SHA512}")
  vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${archive}")
else()
  get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
  if(NOT EXISTS "${SOURCE_PATH}/include/onset/onset.hpp")
    message(FATAL_ERROR "ONSET_SHA512 is empty in ${CMAKE_CURRENT_LIST_FILE}, and this is no clone of onset: ${SOURCE_PATH}")
  endif()
endif()

set(threads STD)
if("tbb" IN_LIST FEATURES)
  set(threads TBB)
endif()
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DONSET_BUILD_TESTS=OFF -DONSET_BUILD_APPS=OFF -DONSET_INSTALL=ON -DONSET_THREADS=${threads})
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/onset)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share" "${CURRENT_PACKAGES_DIR}/share/doc")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
