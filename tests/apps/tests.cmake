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
# Recordings are written with the library that reads them.
if(TARGET test_apps)
  target_link_libraries(test_apps PRIVATE PNG::PNG)
endif()
