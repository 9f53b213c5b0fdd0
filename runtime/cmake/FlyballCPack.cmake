# Debian packages: `cmake --preset package`, build, `cpack --preset package`; for 64-bit Arm boards the
# same with the preset `arm64`.
#
#   libflyball-governor0  the governor alone, for a program of any stack
#   libflyball-dev        headers, libraries and CMake files
#   flyball-data          boards, presets, platforms, airframes, scenarios
#   flyball               the command; not without the simulator
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "Flyball")
set(CPACK_PACKAGE_CONTACT "The Flyball maintainers <maintainers@flyball.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Runtime and governor for micro aerial vehicles")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL governor dev data)
if(FLYBALL_BUILD_SIM)
  list(APPEND CPACK_COMPONENTS_ALL tools)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(same_version "(= ${PROJECT_VERSION})")

# What a program links stands in the program, and dpkg-shlibdeps finds the packages. Across
# architectures it would need theirs installed here.
set(CPACK_DEBIAN_GOVERNOR_PACKAGE_NAME libflyball-governor${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_GOVERNOR_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_GOVERNOR_DESCRIPTION "Governor of knobs and clocks, behind a header of C99")
# It is linked so that it loads with a C library from 2.27 on (governors/shared/older_glibc.c; package.governor
# checks it). dpkg-shlibdeps does not see that and asks for 2.34, which no JetPack has.
get_target_property(sources flyball_governor SOURCES)
if("older_glibc.c" IN_LIST sources)
  set(CPACK_DEBIAN_GOVERNOR_PACKAGE_DEPENDS "libc6 (>= 2.27), libgcc-s1 | libgcc1")
elseif(NOT CMAKE_CROSSCOMPILING)
  set(CPACK_DEBIAN_GOVERNOR_PACKAGE_SHLIBDEPS ON)
endif()
# A new shared library has to be looked for.
file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_GOVERNOR_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/triggers)
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME flyball)
set(CPACK_DEBIAN_TOOLS_DESCRIPTION "Closed-loop simulator and tools of Flyball
 Flies missions with any choice of knobs, compares governors, reads and sets the clocks of a board.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "flyball-data ${same_version}")
# People to look for, and what Haar cascades know of them: photography and search need these.
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "morse-simulator-data, opencv-data")
if(CMAKE_CROSSCOMPILING)
  set(CPACK_FLYBALL_SYSROOT ${CMAKE_SYSROOT})
  set(CPACK_FLYBALL_BUILT ${PROJECT_BINARY_DIR})
  set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/arm64_depends.cmake)
else()
  set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
  set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/native_depends.cmake)
endif()

set(CPACK_DEBIAN_DATA_PACKAGE_NAME flyball-data)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DATA_DESCRIPTION "Boards, presets, platforms, airframes and scenarios of Flyball")

# A component is found where its packages are, so whoever wants the governors alone needs Eigen alone.
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libflyball-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION "Headers, libraries and CMake files of Flyball")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "${CPACK_DEBIAN_GOVERNOR_PACKAGE_NAME} ${same_version}, flyball-data ${same_version}, libeigen3-dev, liblua5.4-dev")
# Compiled in, it is found with the component `policies`.
get_property(needs GLOBAL PROPERTY FLYBALL_NEEDS_policies)
if(needs MATCHES "NLopt")
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libnlopt-dev")
endif()
if(FLYBALL_BUILD_SIM)
  set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS
      "libassimp-dev, libembree-dev, libmrpt-graphslam-dev, libmrpt-poses-dev, libmrpt-topography-dev, liboctomap-dev, libompl-dev, libopencv-contrib-dev, libopencv-dev, libpng-dev, libsimbody-dev, libsqlite3-dev, libzstd-dev, nlohmann-json3-dev")
endif()

# The licence asks to go with every copy, and this is where Debian's packages have theirs.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright COMPONENT ${component}
          DESTINATION share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
endforeach()

if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
endif()
include(CPack)
