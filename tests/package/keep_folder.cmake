cmake_minimum_required(VERSION 3.25)
# arm64_sysroot.sh, which runs as root, removes no folder that it has not made.
set(folder ${built}/package/sysroot)
file(REMOVE_RECURSE ${folder})
file(WRITE ${folder}/mine/kept "something of somebody's")
file(MAKE_DIRECTORY ${folder}/tools)
# Where it would go on, nothing may be installed or fetched.
foreach(tool apt-get mmdebstrap sudo)
  file(CREATE_LINK /bin/false ${folder}/tools/${tool} SYMBOLIC)
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} -E env PATH=${folder}/tools:$ENV{PATH}
                        bash ${flyball}/runtime/cmake/arm64_sysroot.sh ${folder}/mine
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said INPUT_FILE /dev/null)
if(NOT failed OR NOT said MATCHES "is not empty" OR NOT EXISTS ${folder}/mine/kept)
  message(FATAL_ERROR "a folder with a file in it is not refused: ${failed}\n${said}")
endif()
# One that it has begun is its own.
file(TOUCH ${folder}/mine/.made-by-flyball)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PATH=${folder}/tools:$ENV{PATH}
                        bash ${flyball}/runtime/cmake/arm64_sysroot.sh ${folder}/mine
                OUTPUT_VARIABLE said ERROR_VARIABLE said INPUT_FILE /dev/null)
if(said MATCHES "is not empty")
  message(FATAL_ERROR "a folder that it has begun is refused:\n${said}")
endif()
