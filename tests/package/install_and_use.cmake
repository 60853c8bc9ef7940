# SPDX-License-Identifier: Apache-2.0
# Installs the component `engine` of BUILD_DIR into a fresh prefix, then configures, builds and runs
# the project in USER_DIR with nothing but that prefix. Fails unless the user's output is as expected.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nexited with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH_DIR})
set(prefix ${SCRATCH_DIR}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --component engine --prefix ${prefix})

set(flags)
if(SANITIZE)
  set(flags -D CMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} -S ${USER_DIR} -B ${SCRATCH_DIR}/build -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_BUILD_TYPE=${BUILD_TYPE} -D CMAKE_PREFIX_PATH=${prefix}
  ${flags})
run(${CMAKE_COMMAND} --build ${SCRATCH_DIR}/build)
run(${SCRATCH_DIR}/build/user)

# The ball covers the gap of 2 m at 1 m/s; equal masses exchange their velocities.
set(expected "at 2 s: 1 meets 2\n1: x = 2 m, v = 0 m/s\n2: x = 4 m, v = 1 m/s\n")
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "expected:\n${expected}\ngot:\n${output}")
endif()

# The installed headers and targets must not lead back to the build or the sources.
cmake_path(GET USER_DIR PARENT_PATH root)
cmake_path(GET root PARENT_PATH root)
cmake_path(GET root PARENT_PATH root)
file(GLOB_RECURSE texts ${prefix}/*.cmake ${prefix}/*.hpp)
foreach(text IN LISTS texts)
  file(STRINGS ${text} traces REGEX "${root}/|${BUILD_DIR}/")
  if(traces)
    message(FATAL_ERROR "${text} names the source or build folder: ${traces}")
  endif()
endforeach()
