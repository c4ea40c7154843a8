# For the debugger: assertions on, nothing optimised.
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(POINSOT_BUILD_TESTS ON CACHE BOOL "")
set(POINSOT_WERROR ON CACHE BOOL "")
