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
set(toolchain -G ${generator} -D CMAKE_CXX_COMPILER=${compiler}
    -D CMAKE_CXX_COMPILER_LAUNCHER=${launcher} -D CMAKE_BUILD_TYPE=${type})
run(${CMAKE_COMMAND} -S ${source} -B ${folder}/build ${toolchain} ${settings})
run(${CMAKE_COMMAND} --build ${folder}/build)
run(${folder}/build/consumer)
if(NOT way STREQUAL "find_package")
  return()
endif()

# The policies alone, on a machine that lacks whatever the rest is built with.
set(lacking "")
foreach(package octomap embree Simbody assimp PNG SQLite3 zstd OpenCV mrpt-graphslam mrpt-topography)
  list(APPEND lacking -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run(${CMAKE_COMMAND} -S ${source} -B ${folder}/policies ${toolchain} ${lacking}
    -D FLYBALL_WAY=find_package -D FLYBALL_COMPONENTS=policies -D CMAKE_PREFIX_PATH=${folder}/prefix)
run(${CMAKE_COMMAND} --build ${folder}/policies)
run(${folder}/policies/consumer)

# What is not there is named.
execute_process(COMMAND ${CMAKE_COMMAND} -S ${source} -B ${folder}/nonsense ${toolchain}
    -D FLYBALL_WAY=find_package -D FLYBALL_COMPONENTS=nonsense -D CMAKE_PREFIX_PATH=${folder}/prefix
  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE text)
if(NOT failed OR NOT text MATCHES "no component \"nonsense\"")
  message(FATAL_ERROR "a component that does not exist: ${failed} ${text}")
endif()

if(sim)
  # From the build folder: by the environment, and without it where Flyball was to be installed.
  run(${CMAKE_COMMAND} -E env FLYBALL_DATA=${folder}/prefix/share/flyball
      ${folder}/build/flight_consumer)
  cmake_path(IS_PREFIX built ${install_prefix} is_ours)
  if(is_ours)  # Else it is the user's: nothing is installed there.
    run(${CMAKE_COMMAND} --install ${built})
    run(${folder}/build/flight_consumer)
  endif()
  # From the prefix.
  run(${CMAKE_COMMAND} --install ${folder}/build --prefix ${folder}/prefix)
  run(${folder}/prefix/bin/flight_consumer)
  run(${folder}/prefix/bin/flyball list scenarios)
  run(${folder}/prefix/bin/own_workload)
  run(${folder}/prefix/bin/on_board)
  # What flies needs nothing of what simulates.
  execute_process(COMMAND ldd ${folder}/prefix/bin/on_board OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
  if(libraries MATCHES "libSimTK|libembree|libassimp")
    message(FATAL_ERROR "a program of flyball::flight alone needs the simulator's libraries:\n${libraries}")
  endif()
endif()
