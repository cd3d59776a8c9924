# How the library itself is compiled. Its arithmetic is part of its promise: no contraction, no fast-math, no -march.
# These flags come after CMAKE_CXX_FLAGS, so they also hold inside a parent project that sets -ffast-math.
set_target_properties(onset PROPERTIES
  POSITION_INDEPENDENT_CODE ON
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON
  CXX_EXTENSIONS OFF
  UNITY_BUILD OFF  # whatever a parent project does: files have names of their own, inside
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # 0.x: every minor version may break the ABI
target_compile_features(onset PUBLIC cxx_std_17)
target_compile_definitions(onset PRIVATE $<$<OR:$<CONFIG:Debug>,$<BOOL:${ONSET_ASSERTS}>>:ONSET_ASSERTS>)
# What include/onset/export.hpp asks: whether the library is shared, and who is compiled, it or a user.
get_target_property(onset_type onset TYPE)
if(onset_type STREQUAL "SHARED_LIBRARY")
  target_compile_definitions(onset PRIVATE ONSET_BUILDING INTERFACE ONSET_SHARED)
endif()
target_include_directories(onset PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                 PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(onset PUBLIC Eigen3::Eigen PRIVATE ${onset_threads} $<BUILD_INTERFACE:Boost::boost>)
target_compile_options(onset PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off -fno-fast-math -Wall -Wextra>)

# Inside a project without a build type nothing would be optimised, and nobody have asked for that. Where the project has a -O
# of its own, that holds.
get_directory_property(onset_directory_options COMPILE_OPTIONS)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES
   AND NOT "${CMAKE_CXX_FLAGS} ${onset_directory_options}" MATCHES "(^|[ ;])-O")
  target_compile_options(onset PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-O2>)
  message(STATUS "onset: CMAKE_BUILD_TYPE is not set; the library is compiled with -O2, the rest of ${CMAKE_PROJECT_NAME} is not")
endif()

# Tests see the rooms inside, which a shared library hides: for them the same objects in a static one.
if(ONSET_BUILD_TESTS AND BUILD_SHARED_LIBS)
  get_target_property(onset_sources onset SOURCES)
  add_library(onset_inside STATIC ${onset_sources})
  target_include_directories(onset_inside PUBLIC ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
  target_compile_features(onset_inside PUBLIC cxx_std_17)
  target_compile_definitions(onset_inside PRIVATE $<TARGET_PROPERTY:onset,COMPILE_DEFINITIONS>)
  target_compile_options(onset_inside PRIVATE $<TARGET_PROPERTY:onset,COMPILE_OPTIONS>)
  target_link_libraries(onset_inside PUBLIC Eigen3::Eigen PRIVATE ${onset_threads} Boost::boost)
else()
  add_library(onset_inside ALIAS onset)
endif()
