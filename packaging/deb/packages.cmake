# What cpack makes packages for Debian and Ubuntu of: libonset<soversion>, libonset-dev and onset-tools. scripts/package-deb.sh says
# with which options.
if(NOT BUILD_SHARED_LIBS OR NOT ONSET_BUILD_APPS)
  message(FATAL_ERROR "ONSET_DEB packs a shared library and the command line: BUILD_SHARED_LIBS and ONSET_BUILD_APPS have to be ON")
endif()
find_program(GZIP_PROGRAM gzip REQUIRED)
find_program(HELP2MAN_PROGRAM help2man REQUIRED)

set(onset_deb_release 1)
set(onset_deb_version ${PROJECT_VERSION}-${onset_deb_release})
set(onset_deb_library libonset${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(onset_deb_dir ${CMAKE_CURRENT_BINARY_DIR}/deb)

# One manual page, of what the program says about itself and each of its subcommands.
add_custom_command(
  OUTPUT ${onset_deb_dir}/onset.1.gz
  COMMAND ${CMAKE_COMMAND} -E env HELP2MAN=${HELP2MAN_PROGRAM} ${CMAKE_CURRENT_LIST_DIR}/manual-page.sh $<TARGET_FILE:onset_cli>
          ${onset_deb_dir}/onset.1
  COMMAND ${GZIP_PROGRAM} -9 -n -f ${onset_deb_dir}/onset.1
  DEPENDS onset_cli ${CMAKE_CURRENT_LIST_DIR}/manual-page.sh
  VERBATIM)
add_custom_target(onset_deb DEPENDS onset onset_cli ${onset_deb_dir}/onset.1.gz)
install(FILES ${onset_deb_dir}/onset.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)

# The changelog has the day of the newest commit, or SOURCE_DATE_EPOCH: not that of the build.
set(onset_deb_time $ENV{SOURCE_DATE_EPOCH})
if(NOT onset_deb_time)
  execute_process(COMMAND git log -1 --format=%ct WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  OUTPUT_VARIABLE onset_deb_time OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT onset_deb_time)
  message(FATAL_ERROR "Outside of a clone SOURCE_DATE_EPOCH has to say when the source was made")
endif()
execute_process(COMMAND date -u -R -d @${onset_deb_time} OUTPUT_VARIABLE onset_deb_date OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
set(onset_deb_maintainer "The Onset authors <onset@git.example>")
configure_file(${CMAKE_CURRENT_LIST_DIR}/changelog.in ${onset_deb_dir}/changelog.Debian @ONLY)
execute_process(COMMAND ${GZIP_PROGRAM} -9 -n -f changelog.Debian WORKING_DIRECTORY ${onset_deb_dir} COMMAND_ERROR_IS_FATAL ANY)

# A package of one component: its summary, its description, and fields of the control file.
set(CPACK_COMPONENTS_ALL "")
macro(onset_deb_package component name section summary description)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} onset_deb_prefix)
  set(onset_deb_prefix CPACK_DEBIAN_${onset_deb_prefix})
  set(${onset_deb_prefix}_PACKAGE_NAME ${name})
  set(${onset_deb_prefix}_PACKAGE_SECTION ${section})
  set(${onset_deb_prefix}_DESCRIPTION "${summary}\n${description}")
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/copyright ${onset_deb_dir}/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name} COMPONENT ${component})
endmacro()
set(onset_deb_about "Onset tells how far a moving triangle mesh can go before anything touches,
and which pairs of a vertex and a face or of two edges touch when. Rounding
can make it report a contact early, never late. It is meant for simulators
of cloth, solids and rigid bodies.")

onset_deb_package(library ${onset_deb_library} libs "conservative continuous collision detection - shared library"
  "${onset_deb_about}\n\nThis package has the library that programs run with.")
onset_deb_package(development libonset-dev libdevel "conservative continuous collision detection - development files"
  "${onset_deb_about}\n\nThis package has the headers, and what CMake and pkg-config need to find\nthe library.")
onset_deb_package(tools onset-tools science "conservative continuous collision detection - command line"
  "${onset_deb_about}\n\nThis package has the program onset, which answers about mesh files (OBJ,
PLY, OFF, STL): how far a step can go, what touches, and whether a step can
start there.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${onset_deb_library} (= ${onset_deb_version}), libeigen3-dev")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${onset_deb_library} (= ${onset_deb_version})")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME onset)
set(CPACK_PACKAGE_VENDOR "The Onset authors")
set(CPACK_PACKAGE_CONTACT "${onset_deb_maintainer}")
set(CPACK_PACKAGE_DIRECTORY ${onset_deb_dir})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${onset_deb_release})
set(CPACK_DEBIAN_PACKAGE_SOURCE onset)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# The library that the program asks for is the one beside it.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_POST_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish.cmake)
include(CPack)
