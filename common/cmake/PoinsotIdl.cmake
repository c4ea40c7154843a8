# poinsot_idl(NAME EXPORT set AS name FILES a.idl b.idl ...)
#
# A static library of the message types, generated at build time into the build tree and included as
# "poinsot/msg/<file>.h". Type objects are not generated: announcing nested ones ends other Fast DDS
# 2.9.1 processes on the domain, and Cyclone DDS refuses to match them. The IDL files are installed for
# users of other vendors.

find_program(POINSOT_FASTDDSGEN fastddsgen REQUIRED)

function(poinsot_idl name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "EXPORT;AS" "FILES")
  set(root ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(out ${root}/poinsot/msg)
  file(MAKE_DIRECTORY ${out})  # fastddsgen does not

  set(idl_files "")
  set(generated "")
  set(sources "")
  foreach(file IN LISTS arg_FILES)
    list(APPEND idl_files ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    cmake_path(GET file STEM stem)
    list(APPEND generated ${out}/${stem}.h ${out}/${stem}.cxx ${out}/${stem}PubSubTypes.h
         ${out}/${stem}PubSubTypes.cxx)
    list(APPEND sources ${out}/${stem}.cxx ${out}/${stem}PubSubTypes.cxx)
  endforeach()
  # The generator leaves object addresses in comments; without them the output is reproducible.
  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${POINSOT_FASTDDSGEN} -replace -cs -I ${CMAKE_CURRENT_SOURCE_DIR} -d ${out} ${idl_files}
            > ${out}/fastddsgen.log
    COMMAND sed -i "s/@[0-9a-f]*$//" ${generated}
    DEPENDS ${idl_files}
    COMMENT "Generating message types"
    VERBATIM)

  add_library(${name} STATIC ${sources})
  add_library(Poinsot::${arg_AS} ALIAS ${name})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${arg_AS} POSITION_INDEPENDENT_CODE ON
                                           CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden
                                           VISIBILITY_INLINES_HIDDEN ON)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_include_directories(${name} SYSTEM PUBLIC $<BUILD_INTERFACE:${root}>)
  target_link_libraries(${name} PUBLIC fastrtps fastcdr)
  target_compile_options(${name} PRIVATE -w)  # foreign code
  install(TARGETS ${name} EXPORT ${arg_EXPORT} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES ${idl_files} DESTINATION ${CMAKE_INSTALL_DATADIR}/poinsot/idl)
endfunction()
