cmake_minimum_required(VERSION 3.25)
# The governor alone: builds and installs runtime, governors and policies where none of the libraries of
# kernels and simulator is to be found, then builds programs in C against it in both ways that there are.
set(folder ${built}/package/governor)
file(REMOVE_RECURSE ${folder})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${text}")
  endif()
  set(said "${text}" PARENT_SCOPE)
endfunction()

set(lacking "")
foreach(package octomap embree Simbody assimp PNG SQLite3 zstd OpenCV mrpt-graphslam mrpt-topography NLopt
                CLI11 nlohmann_json GTest benchmark)
  list(APPEND lacking -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
set(toolchain -G ${generator} -D CMAKE_C_COMPILER=${c_compiler} -D CMAKE_CXX_COMPILER=${compiler}
    -D CMAKE_CXX_COMPILER_LAUNCHER=${launcher})
run(${CMAKE_COMMAND} -S ${flyball} -B ${folder}/flyball ${toolchain} ${lacking} -D FLYBALL_BUILD_SIM=OFF
    -D FLYBALL_BUILD_TESTS=OFF -D FLYBALL_BUILD_EXAMPLES=OFF
    -D CMAKE_UNITY_BUILD=ON)  # Quicker; build_consumer.cmake compiles each file alone.
run(${CMAKE_COMMAND} --build ${folder}/flyball)
run(${CMAKE_COMMAND} --install ${folder}/flyball --prefix ${folder}/first)
# What is installed may be moved.
file(RENAME ${folder}/first ${folder}/prefix)

# It needs the C library, and shows the functions of its header.
file(GLOB_RECURSE library ${folder}/prefix/*/libflyball_governor.so)
run(ldd ${library})
string(REGEX MATCHALL "[A-Za-z0-9_+-]+\\.so" needed "${said}")
list(FILTER needed EXCLUDE REGEX "^(linux-vdso|ld-linux[a-z0-9_-]*|libc|libm|libpthread|libdl|libgcc_s)\\.so$")
if(needed OR NOT said MATCHES "libc\\.so")
  message(FATAL_ERROR "libflyball_governor needs more than the C library: ${needed}\n${said}")
endif()
# That of JetPack 4 is 2.27.
run(objdump -T ${library})
string(REGEX MATCHALL "GLIBC_[0-9.]+[^\n]*" symbols "${said}")
foreach(symbol IN LISTS symbols)
  string(REGEX MATCH "^GLIBC_([0-9.]+)" version "${symbol}")
  if(CMAKE_MATCH_1 VERSION_GREATER 2.27)
    message(FATAL_ERROR "libflyball_governor needs ${symbol}: governors/shared/older_glibc.c tells what to do")
  endif()
endforeach()
if(NOT symbols)
  message(FATAL_ERROR "objdump tells no version of a symbol:\n${said}")
endif()
run(nm -D --defined-only ${library})
string(REGEX REPLACE "[0-9a-f]+ T flyball_governor_[a-z_]+" "" others "${said}")
if(others MATCHES "[a-z]" OR NOT said MATCHES " T flyball_governor_decide")
  message(FATAL_ERROR "libflyball_governor shows other names than those of its header:\n${said}")
endif()

# By CMake, on a machine without Eigen, threads and Lua too: a project in C alone.
run(${CMAKE_COMMAND} -S ${source}/governor -B ${folder}/by_cmake ${toolchain} ${lacking}
    -D CMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON -D CMAKE_DISABLE_FIND_PACKAGE_Threads=ON
    -D FLYBALL_EXAMPLE=${flyball}/examples/04_govern_from_c.c -D CMAKE_PREFIX_PATH=${folder}/prefix)
run(${CMAKE_COMMAND} --build ${folder}/by_cmake)
run(${folder}/by_cmake/mine)

# By pkg-config.
find_program(pkg_config pkg-config)
if(NOT pkg_config)
  message(STATUS "there is no pkg-config here, so flyball_governor.pc was not tried")
  return()
endif()
file(GLOB_RECURSE description ${folder}/prefix/*/flyball_governor.pc)
cmake_path(GET description PARENT_PATH descriptions)
cmake_path(GET library PARENT_PATH libraries)
run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${descriptions} ${pkg_config} --cflags --libs flyball_governor)
separate_arguments(flags UNIX_COMMAND "${said}")
run(${c_compiler} -std=c99 -pedantic -Wall -Wextra -Werror ${flyball}/examples/04_govern_from_c.c ${flags}
    -o ${folder}/by_pkg_config)
run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${libraries} ${folder}/by_pkg_config)
if(NOT said MATCHES "right")
  message(FATAL_ERROR "the example says: ${said}")
endif()
run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${descriptions} ${pkg_config} --modversion flyball_governor)
if(NOT said MATCHES "^[0-9]+\\.[0-9]+\\.[0-9]+$")
  message(FATAL_ERROR "the version is ${said}")
endif()
