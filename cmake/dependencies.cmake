# What the library itself needs. A parent project may bring its own Eigen3::Eigen and TBB::tbb.
function(onset_require found what variable package)
  if(NOT found)
    message(FATAL_ERROR "onset needs ${what}, which was not found. On Debian and Ubuntu: apt-get install ${package}. "
                        "Elsewhere CMAKE_PREFIX_PATH or ${variable} says where it is.")
  endif()
endfunction()

if(NOT TARGET Eigen3::Eigen)
  find_package(Eigen3 QUIET NO_MODULE)
  onset_require("${Eigen3_FOUND}" "Eigen 3.4" Eigen3_DIR libeigen3-dev)
  if(Eigen3_VERSION VERSION_LESS 3.4)
    message(FATAL_ERROR "onset needs Eigen 3.4 or newer, found ${Eigen3_VERSION} in ${Eigen3_DIR}")
  endif()
endif()
if(NOT TARGET TBB::tbb)
  find_package(TBB QUIET)
  onset_require("${TBB_FOUND}" oneTBB TBB_DIR libtbb-dev)
endif()
# Boost.Multiprecision, headers only: integers of any size for the exact decision. Nothing of it is linked or exported.
if(NOT TARGET Boost::boost)
  find_package(Boost 1.74 QUIET)
  onset_require("${Boost_FOUND}" "Boost 1.74 (headers only)" Boost_ROOT libboost-dev)
endif()
