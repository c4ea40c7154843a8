# Address and undefined-behaviour sanitizers, with assertions and enough optimisation to be bearable.
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1" CACHE STRING "")
set(POINSOT_BUILD_TESTS ON CACHE BOOL "")
set(POINSOT_WERROR ON CACHE BOOL "")
set(POINSOT_SANITIZE address CACHE STRING "")
