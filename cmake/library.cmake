# How the library itself is compiled. Its arithmetic is part of its promise: no contraction, no fast-math, no -march.
set_target_properties(onset PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                       VISIBILITY_INLINES_HIDDEN ON)
target_compile_features(onset PUBLIC cxx_std_17)
target_include_directories(onset PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
                                 PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(onset PUBLIC Eigen3::Eigen PRIVATE TBB::tbb)
target_compile_options(onset PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off -fno-fast-math -Wall -Wextra>)
