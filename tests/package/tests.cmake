# A stranger's project builds and runs against Flyball, in both ways that there are.
set(consumer_settings
  -D source=${CMAKE_CURRENT_LIST_DIR}
  -D flyball=${PROJECT_SOURCE_DIR}
  -D built=${PROJECT_BINARY_DIR}
  -D generator=${CMAKE_GENERATOR}
  -D compiler=${CMAKE_CXX_COMPILER}
  -D c_compiler=${CMAKE_C_COMPILER}
  -D launcher=${CMAKE_CXX_COMPILER_LAUNCHER}
  -D type=${CMAKE_BUILD_TYPE}
  -D install_prefix=${CMAKE_INSTALL_PREFIX}
  -D sim=${FLYBALL_BUILD_SIM})
foreach(way find_package add_subdirectory)
  add_test(NAME package.${way} COMMAND ${CMAKE_COMMAND} ${consumer_settings} -D way=${way}
                                       -P ${CMAKE_CURRENT_LIST_DIR}/build_consumer.cmake)
  set_tests_properties(package.${way} PROPERTIES LABELS package TIMEOUT 600)
endforeach()
add_test(NAME package.governor COMMAND ${CMAKE_COMMAND} ${consumer_settings}
                                       -P ${CMAKE_CURRENT_LIST_DIR}/build_governor.cmake)
set_tests_properties(package.governor PROPERTIES LABELS package TIMEOUT 600)
find_program(dpkg_shlibdeps dpkg-shlibdeps)
if(dpkg_shlibdeps)
  add_test(NAME package.debs COMMAND ${CMAKE_COMMAND} ${consumer_settings}
                                     -P ${CMAKE_CURRENT_LIST_DIR}/build_debs.cmake)
  set_tests_properties(package.debs PROPERTIES LABELS package TIMEOUT 600)
endif()
add_test(NAME package.sysroot COMMAND ${CMAKE_COMMAND} ${consumer_settings}
                                      -P ${CMAKE_CURRENT_LIST_DIR}/keep_folder.cmake)
set_tests_properties(package.sysroot PROPERTIES LABELS package TIMEOUT 60)
find_program(systemd_analyze systemd-analyze)
if(FLYBALL_BUILD_SIM AND systemd_analyze)
  add_test(NAME package.service COMMAND ${CMAKE_COMMAND} ${consumer_settings} -D analyze=${systemd_analyze}
                                        -P ${CMAKE_CURRENT_LIST_DIR}/check_service.cmake)
  set_tests_properties(package.service PROPERTIES LABELS package TIMEOUT 60)
endif()
if(FLYBALL_BUILD_SIM)
  add_test(NAME package.policy COMMAND ${CMAKE_COMMAND} ${consumer_settings}
                                       -P ${CMAKE_CURRENT_LIST_DIR}/build_policy.cmake)
  if(TARGET flyball_launcher)
    add_test(NAME package.bundle COMMAND ${CMAKE_COMMAND} ${consumer_settings}
                                         -P ${CMAKE_CURRENT_LIST_DIR}/start_bundle.cmake)
    set_tests_properties(package.bundle PROPERTIES LABELS package TIMEOUT 600
                                                   SKIP_REGULAR_EXPRESSION "unshare: ")
  endif()
  set_tests_properties(package.policy PROPERTIES LABELS package TIMEOUT 600)
endif()
