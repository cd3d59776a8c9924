# What the library itself needs. A parent project may bring its own Eigen3::Eigen and TBB::tbb.
if(NOT TARGET Eigen3::Eigen)
  find_package(Eigen3 REQUIRED NO_MODULE)
  if(Eigen3_VERSION VERSION_LESS 3.4)
    message(FATAL_ERROR "onset needs Eigen 3.4 or newer, found ${Eigen3_VERSION} in ${Eigen3_DIR}")
  endif()
endif()
if(NOT TARGET TBB::tbb)
  find_package(TBB REQUIRED)
endif()
# Boost.Multiprecision, headers only: integers of any size for the exact decision. Nothing of it is linked or exported.
if(NOT TARGET Boost::boost)
  find_package(Boost 1.74 REQUIRED)
endif()
