# What users run: optimised, warnings are errors. cmake -C .ci/release.cmake -B build/release -G Ninja
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(POINSOT_BUILD_TESTS ON CACHE BOOL "")
set(POINSOT_WERROR ON CACHE BOOL "")
