# Installs BUILD_DIR into a new prefix, builds the project CONSUMER against it, runs its `consumer`
# and compares the shared libraries that it loads with the project's own list of unwanted ones.
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${what} failed (${code}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(prefix ${WORK_DIR}/prefix)
set(build ${WORK_DIR}/build)
file(REMOVE_RECURSE ${prefix} ${build})
run("installing" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run("configuring the consumer" ${CMAKE_COMMAND} -S ${CONSUMER} -B ${build} -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
    -D CMAKE_BUILD_TYPE=${BUILD_TYPE})
run("building the consumer" ${CMAKE_COMMAND} --build ${build})
run("running the consumer" ${build}/consumer)
message(STATUS "consumer: ${output}")

file(STRINGS ${CONSUMER}/unwanted_libraries.txt unwanted)
run("ldd" ldd ${build}/consumer)
foreach(library IN LISTS unwanted)
  if(output MATCHES "${library}")
    message(FATAL_ERROR "the consumer loads ${library}:\n${output}")
  endif()
endforeach()
