# poinsot_target(NAME LIBRARY|EXECUTABLE
#                BASE dir                   include root of the headers
#                SOURCES ... HEADERS ...
#                PUBLIC ... PRIVATE ...     libraries
#                [EXPORT set AS name])      install and export as Poinsot::name
#
# The one place for warnings, sanitizers, visibility and the flags that keep runs bit-identical.

function(poinsot_target name kind)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "BASE;EXPORT;AS" "SOURCES;HEADERS;PUBLIC;PRIVATE")
  if(kind STREQUAL "LIBRARY")
    add_library(${name} STATIC ${arg_SOURCES})
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON
                                             VERIFY_INTERFACE_HEADER_SETS ON)
    if(arg_AS)
      add_library(Poinsot::${arg_AS} ALIAS ${name})
      set_target_properties(${name} PROPERTIES EXPORT_NAME ${arg_AS})
    endif()
  else()
    add_executable(${name} ${arg_SOURCES})
  endif()
  if(arg_HEADERS)
    target_sources(${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${arg_BASE} FILES ${arg_HEADERS})
  endif()
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden
                                           VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  # Packaged FCL is built for generic x86-64: wider Eigen alignment would change its type layouts.
  target_compile_definitions(${name} PUBLIC EIGEN_MAX_ALIGN_BYTES=16)
  # No fused multiply-add: the compiler must not choose between two roundings.
  target_compile_options(${name} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion
                                         -Wshadow $<$<BOOL:${POINSOT_WERROR}>:-Werror>)
  if(POINSOT_SANITIZE STREQUAL "address")
    target_compile_options(${name} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                           -fno-omit-frame-pointer)
    target_link_options(${name} PUBLIC -fsanitize=address,undefined)
  elseif(POINSOT_SANITIZE STREQUAL "thread")
    target_compile_options(${name} PRIVATE -fsanitize=thread -fno-omit-frame-pointer)
    target_link_options(${name} PUBLIC -fsanitize=thread)
  endif()
  if(arg_EXPORT)
    install(TARGETS ${name} EXPORT ${arg_EXPORT} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
            FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
endfunction()
