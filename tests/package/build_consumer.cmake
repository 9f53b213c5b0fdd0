cmake_minimum_required(VERSION 3.25)
# Installs Flyball into a prefix of its own, then configures, builds and runs the project beside this
# file as a user would.
set(folder ${built}/package/${way})
file(REMOVE_RECURSE ${folder})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(failed)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${text}")
  endif()
endfunction()

set(settings -D FLYBALL_WAY=${way} -D WITH_APPS=OFF)
if(way STREQUAL "find_package")
  run(${CMAKE_COMMAND} --install ${built} --prefix ${folder}/prefix)
  set(settings -D FLYBALL_WAY=${way} -D WITH_APPS=${sim} -D CMAKE_PREFIX_PATH=${folder}/prefix)
else()
  # What an embedder with kernels of his own takes: without kernels, simulator and workloads.
  list(APPEND settings -D FLYBALL_SOURCE=${flyball} -D FLYBALL_BUILD_SIM=OFF)
  set(type "")  # As who sets nothing: it compiles in half the time.
endif()
run(${CMAKE_COMMAND} -S ${source} -B ${folder}/build -G ${generator} ${settings}
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_COMPILER_LAUNCHER=${launcher}
    -D CMAKE_BUILD_TYPE=${type})
run(${CMAKE_COMMAND} --build ${folder}/build)
run(${folder}/build/consumer)
if(way STREQUAL "find_package" AND sim)
  run(${CMAKE_COMMAND} --install ${folder}/build --prefix ${folder}/prefix)
  run(${folder}/prefix/bin/flight_consumer)
  run(${folder}/prefix/bin/flyball list scenarios)
endif()
