# poinsot_documentation(TARGET NAME): the manual page and the completion scripts of a program, which it
# writes itself, installed where man and the shells look for them.

function(poinsot_documentation target name)
  set(man ${PROJECT_BINARY_DIR}/share/man/man1/${name}.1)
  set(bash ${PROJECT_BINARY_DIR}/share/bash-completion/completions/${name})
  set(zsh ${PROJECT_BINARY_DIR}/share/zsh/site-functions/_${name})
  set(fish ${PROJECT_BINARY_DIR}/share/fish/vendor_completions.d/${name}.fish)
  foreach(file ${man} ${bash} ${zsh} ${fish})
    get_filename_component(directory ${file} DIRECTORY)
    file(MAKE_DIRECTORY ${directory})
  endforeach()
  add_custom_command(OUTPUT ${man} ${bash} ${zsh} ${fish}
    COMMAND ${target} man > ${man}
    COMMAND ${target} completion bash > ${bash}
    COMMAND ${target} completion zsh > ${zsh}
    COMMAND ${target} completion fish > ${fish}
    DEPENDS ${target} COMMENT "Manual page and completion of ${name}")
  add_custom_target(${target}_documentation ALL DEPENDS ${man} ${bash} ${zsh} ${fish})
  install(FILES ${man} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${bash} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${zsh} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${fish} DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endfunction()
