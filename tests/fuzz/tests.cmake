# Mutation fuzzing of the program (fuzz_inputs.py), and libFuzzer's targets for single parsers.
set(fuzz ${CMAKE_CURRENT_LIST_DIR})
# flyball_fuzz_settings(<target>): what targets/*_fuzzer.cpp include and know.
function(flyball_fuzz_settings target)
  set(folders governors/src kernels/src sim/src apps tests/kit)
  list(TRANSFORM folders PREPEND ${PROJECT_SOURCE_DIR}/)
  target_include_directories(${target} PRIVATE ${folders})
  target_compile_definitions(${target} PRIVATE
    FLYBALL_PLATFORMS="${PROJECT_SOURCE_DIR}/sim/platforms"
    $<$<TARGET_EXISTS:flyball_lua>:FLYBALL_HAS_LUA>)
endfunction()
find_package(Python3 3.9 QUIET COMPONENTS Interpreter)
if(TARGET flyball_cli AND Python3_FOUND)
  # A library that the driver damages further: its process sends packets of its own.
  add_library(fuzz_packets MODULE ${fuzz}/packets.cpp)
  target_link_libraries(fuzz_packets PRIVATE flyball::governors)
  target_include_directories(fuzz_packets PRIVATE ${PROJECT_SOURCE_DIR}/governors/src)
  set_target_properties(fuzz_packets PROPERTIES
    PREFIX "" OUTPUT_NAME packets LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/fuzz)
  # Two cases of each kind: that the driver still finds its way, not that nothing is left to find.
  add_test(NAME fuzz_inputs
           COMMAND ${Python3_EXECUTABLE} ${fuzz}/fuzz_inputs.py --count 2
                   --flyball $<TARGET_FILE:flyball_cli> --packets $<TARGET_FILE:fuzz_packets>
                   --out ${PROJECT_BINARY_DIR}/fuzz/findings)
  set_tests_properties(fuzz_inputs PROPERTIES LABELS fuzz TIMEOUT 300)
endif()

# Every build compiles libFuzzer's targets, without libFuzzer: what only clang sees grows stale.
if(FLYBALL_BUILD_SIM AND TARGET flyball_lua AND TARGET GTest::gtest)
  file(GLOB fuzz_sources CONFIGURE_DEPENDS ${fuzz}/targets/*_fuzzer.cpp)
  add_library(fuzz_sources OBJECT ${fuzz_sources})
  set_target_properties(fuzz_sources PROPERTIES UNITY_BUILD OFF)
  target_link_libraries(fuzz_sources PRIVATE flyball::apps flyball_lua octomap octomath PNG::PNG
                                             GTest::gtest)
  flyball_fuzz_settings(fuzz_sources)
  flyball_compile_options(fuzz_sources)
endif()

option(FLYBALL_BUILD_FUZZERS "Build libFuzzer's targets; needs clang (preset fuzz)" OFF)
if(NOT FLYBALL_BUILD_FUZZERS)
  return()
endif()
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "FLYBALL_BUILD_FUZZERS needs clang, which has libFuzzer: cmake --preset fuzz")
endif()
add_custom_target(fuzzers)
if(TARGET flyball_kernels)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/kernels/src/scans/inner_loops.cpp
    TARGET_DIRECTORY flyball_kernels
    PROPERTIES COMPILE_OPTIONS "-include;${fuzz}/targets/gcc_shuffle.h")
endif()
# flyball_fuzzer(<name> LIBRARIES ...): bin/<name>_fuzzer of targets/<name>_fuzzer.cpp.
function(flyball_fuzzer name)
  cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
  add_executable(${name}_fuzzer EXCLUDE_FROM_ALL ${fuzz}/targets/${name}_fuzzer.cpp)
  target_link_libraries(${name}_fuzzer PRIVATE ${arg_LIBRARIES})
  target_link_options(${name}_fuzzer PRIVATE -fsanitize=fuzzer)
  flyball_fuzz_settings(${name}_fuzzer)
  add_dependencies(fuzzers ${name}_fuzzer)
endfunction()
flyball_fuzzer(preset LIBRARIES flyball::governors)
flyball_fuzzer(packet LIBRARIES flyball::governors)
if(TARGET flyball_lua)
  flyball_fuzzer(script LIBRARIES flyball::governors flyball_lua)
  flyball_fuzzer(format LIBRARIES flyball::governors flyball_lua)
endif()
if(FLYBALL_BUILD_SIM)
  flyball_fuzzer(scan LIBRARIES flyball::sim)
  flyball_fuzzer(platform LIBRARIES flyball::sim)
  flyball_fuzzer(airframe LIBRARIES flyball::sim)
  flyball_fuzzer(map LIBRARIES flyball::kernels octomap octomath)
  flyball_fuzzer(scenario LIBRARIES flyball::scenario)
  flyball_fuzzer(mavlink LIBRARIES flyball::vehicles)
  flyball_fuzzer(record LIBRARIES flyball::studies)
  flyball_fuzzer(recording LIBRARIES flyball::recordings PNG::PNG GTest::gtest)
  flyball_fuzzer(png LIBRARIES flyball::recordings PNG::PNG)
endif()
