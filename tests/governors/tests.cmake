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
target_compile_definitions(test_governors PRIVATE
  FLYBALL_TEST_PLUGINS="${PROJECT_BINARY_DIR}/test_plugins")
if(TARGET flyball_lua)
  target_compile_definitions(test_governors PRIVATE FLYBALL_HAS_LUA)
  target_link_libraries(test_governors PRIVATE flyball_lua)
endif()
