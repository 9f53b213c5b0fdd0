# Policies in shared libraries that break their contract, each in its own way.
function(flyball_test_plugin name source)
  add_library(${name} MODULE ${PROJECT_SOURCE_DIR}/tests/governors/plugins/${source})
  target_link_libraries(${name} PRIVATE flyball::governors)
  target_compile_definitions(${name} PRIVATE ${ARGN})
  set_target_properties(${name} PROPERTIES
    PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test_plugins)
  add_dependencies(test_governors ${name})
endfunction()
flyball_test_plugin(culprit culprit.c)
flyball_test_plugin(culprit_older culprit.c OLDER)
flyball_test_plugin(culprit_too_old culprit.c TOO_OLD)
flyball_test_plugin(thrower thrower.cpp)
flyball_test_plugin(hostile hostile.c)
target_compile_definitions(test_governors PRIVATE
  FLYBALL_TEST_PLUGINS="${PROJECT_BINARY_DIR}/test_plugins")
if(TARGET flyball_lua)
  target_compile_definitions(test_governors PRIVATE FLYBALL_HAS_LUA)
  target_link_libraries(test_governors PRIVATE flyball_lua)
endif()
# Callers of flyball/governors/governor.h in C99: with the header as it is, and as it was at first.
foreach(name c99_header older_caller)
  add_executable(${name} ${PROJECT_SOURCE_DIR}/tests/governors/embedding/${name}.c)
  target_link_libraries(${name} PRIVATE flyball::governor)
  set_target_properties(${name} PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
  target_compile_options(${name} PRIVATE -pedantic -Wall -Wextra -Werror)
  add_test(NAME embedding.${name} COMMAND ${name})
  set_tests_properties(embedding.${name} PROPERTIES LABELS unit)
endforeach()
target_compile_features(test_embedding PRIVATE cxx_std_17)
target_compile_definitions(test_embedding PRIVATE
  FLYBALL_EXAMPLE_POLICIES="${PROJECT_SOURCE_DIR}/examples/policies"
  FLYBALL_TEST_PLUGINS="${PROJECT_BINARY_DIR}/test_plugins")
add_dependencies(test_embedding culprit)
add_test(NAME embedding.added_lines COMMAND ${CMAKE_COMMAND} -D root=${PROJECT_SOURCE_DIR}
         -P ${PROJECT_SOURCE_DIR}/tests/governors/embedding/added_lines.cmake)
set_tests_properties(embedding.added_lines PROPERTIES LABELS unit)
