# The command line's tests run the built program.
if(TARGET test_apps AND TARGET flyball_cli)
  add_dependencies(test_apps flyball_cli)
endif()
if(TARGET test_closed_loop AND TARGET flyball_cli)
  add_dependencies(test_closed_loop flyball_cli)
  target_include_directories(test_closed_loop PRIVATE ${CMAKE_CURRENT_LIST_DIR})
  target_compile_definitions(test_closed_loop PRIVATE
    FLYBALL_CLOSED_LOOP_TESTS="${PROJECT_SOURCE_DIR}/tests/closed_loop"
    $<$<TARGET_EXISTS:flyball_lua>:FLYBALL_HAS_LUA>)
endif()
# Recordings are written with the library that reads them, and stores are asked with theirs.
if(TARGET test_apps)
  target_link_libraries(test_apps PRIVATE PNG::PNG SQLite::SQLite3)
endif()
# Libraries of kernels for `--kernels`, most of them with a fault.
function(flyball_test_kernels name)
  add_library(${name} MODULE ${PROJECT_SOURCE_DIR}/tests/apps/libraries/kernels.cpp)
  target_link_libraries(${name} PRIVATE flyball::kernels)
  target_compile_definitions(${name} PRIVATE LIBRARY=${name} ${ARGN})
  set_target_properties(${name} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test_kernels_of_others)
  add_dependencies(test_apps ${name})
endfunction()
if(TARGET test_apps)
  flyball_test_kernels(blind ADDS="blind")
  flyball_test_kernels(blind_too ADDS="blind")
  flyball_test_kernels(second_hog ADDS="hog")
  flyball_test_kernels(empty_handed)
  flyball_test_kernels(sulking THROWS)
  target_compile_definitions(test_apps PRIVATE
    FLYBALL_TEST_KERNELS="${PROJECT_BINARY_DIR}/test_kernels_of_others")
endif()
