# Tests and apps. ON: they are built, and what they need has to be there. AUTO: they are built where it is there, and left out,
# with a line that says so, where it is not.

# What each needs beyond the library: "<arguments of find_package>=<Debian package>", or a header for find_path into a variable.
set(onset_tests_need Catch2=catch2 TBB=libtbb-dev "nlohmann_json=nlohmann-json3-dev" fcl=libfcl-dev PkgConfig=pkg-config Python3=python3
                     Git=git)
set(onset_apps_need CLI11=libcli11-dev "nlohmann_json 3.10=nlohmann-json3-dev"
                    "CGAL_INCLUDE_DIR CGAL/box_intersection_d.h=libcgal-dev")

# Makes of <option> what is built: ON or OFF, in the caller's scope. <what> is the folder, as messages name it.
function(onset_decide option what)
  if(NOT ${option})
    return()
  endif()
  set(missing "")
  set(packages "")
  foreach(need IN LISTS ARGN)
    string(REGEX MATCH "^([^ =]+) ?([^=]*)=(.*)$" need "${need}")
    set(name ${CMAKE_MATCH_1})
    set(detail ${CMAKE_MATCH_2})
    set(package ${CMAKE_MATCH_3})
    if(detail MATCHES "\\.h$")
      find_path(${name} ${detail})
      set(found ${${name}})
      set(name ${detail})
      set(detail "")
    else()
      find_package(${name} ${detail} QUIET)
      set(found ${${name}_FOUND})
    endif()
    if(NOT found)
      string(STRIP "${name} ${detail}" name)
      list(APPEND missing ${name})
      list(APPEND packages ${package})
    endif()
  endforeach()

  list(JOIN missing ", " missing)
  list(JOIN packages " " packages)
  if(NOT missing)
    set(${option} ON PARENT_SCOPE)
  elseif("${${option}}" STREQUAL "AUTO")
    message(STATUS "onset: ${what} are left out, not found: ${missing} (Debian, Ubuntu: apt-get install ${packages})")
    set(${option} OFF PARENT_SCOPE)
  else()
    message(FATAL_ERROR "${option} is ${${option}}, and for the ${what} this was not found: ${missing}. "
                        "On Debian and Ubuntu: apt-get install ${packages}")
  endif()
endfunction()

onset_decide(ONSET_BUILD_TESTS tests ${onset_tests_need})
onset_decide(ONSET_BUILD_APPS apps ${onset_apps_need})
