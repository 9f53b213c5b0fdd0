# flyball_compile_options(<target>): warnings, and the flags that keep floating point the same in
# every build type (constant folding and fused multiply-add change bits). A compiler that collects
# its garbage only above half a GB takes a twelfth less time. Where neighbouring files are compiled
# together, a name of one may hide a name of another, and a type of no linkage stands in no main file.
function(flyball_compile_options target)
  if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    set(of_neighbours -Wshadow=local -Wno-subobject-linkage)
  else()
    set(of_neighbours -Wshadow)
  endif()
  target_compile_options(${target} PRIVATE -ffp-contract=off -frounding-math
    $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
    -Wall -Wextra -Wpedantic -Wconversion ${of_neighbours} -Wnon-virtual-dtor -Woverloaded-virtual
    $<$<BOOL:${FLYBALL_WERROR}>:-Werror>)
  # There Eigen asks for fused multiply-adds by name, which the flag above does not reach, unless it is
  # told that there are none. (Products of large matrices keep them.) With section anchors, g++ 12 places
  # some constants 8 bytes behind where its code looks for them: {1, 2, 3, 4} was read as {1.2, 1, 2, 3}
  # (in test_policies, whose test of each part of mission_energy stops at once when that comes back).
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
    target_compile_options(${target} PRIVATE -U__ARM_FEATURE_FMA -fno-section-anchors)
  endif()
  # OpenCV's and MRPT's targets name a hundred libraries that nothing here calls: a second at every
  # start of a program.
  target_link_options(${target} PRIVATE LINKER:--as-needed)
endfunction()

# flyball_quick_to_compile(<target>): for code whose compilation takes longer than all its runs.
function(flyball_quick_to_compile target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
endfunction()

# A program that stands elsewhere finds share/flyball and lib/flyball here: where they are installed,
# or in the build tree of whoever took this project as a part of his own.
if(PROJECT_IS_TOP_LEVEL)
  set(FLYBALL_RUN_PREFIX ${CMAKE_INSTALL_PREFIX})
else()
  set(FLYBALL_RUN_PREFIX ${PROJECT_BINARY_DIR})
endif()

# flyball_data(<name> <folder> <component>): the program finds it in ../share/flyball/<name>, seen from
# its own folder, in the build tree and installed.
function(flyball_data name folder component)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/flyball)
  file(CREATE_LINK ${folder} ${PROJECT_BINARY_DIR}/share/flyball/${name} SYMBOLIC)
  install(DIRECTORY ${folder}/ DESTINATION share/flyball/${name} COMPONENT ${component})
endfunction()

# flyball_needs(<component> <line>): what an installed Flyball has to do before the component's target
# can be used: `find_dependency(Eigen3)`.
function(flyball_needs component line)
  set_property(GLOBAL APPEND PROPERTY FLYBALL_NEEDS_${component} "${line}")
endfunction()

# flyball_module(<name> SOURCES ... [INCLUDES <folders>] [PUBLIC <targets>] [PRIVATE <targets>])
#   One folder, one target: flyball_<name>, alias flyball::<name>; installed, a component <name>.
#   Public headers are exactly the files under <folder>/include/, or under the folders named.
function(flyball_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;INCLUDES;PUBLIC;PRIVATE" ${ARGN})
  set(target flyball_${name})
  if(NOT arg_INCLUDES)
    set(arg_INCLUDES include)
  endif()
  list(TRANSFORM arg_INCLUDES APPEND /*.h OUTPUT_VARIABLE patterns)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${patterns})
  add_library(${target} ${arg_SOURCES})
  add_library(flyball::${name} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${arg_INCLUDES} FILES ${headers})
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name} VERIFY_INTERFACE_HEADER_SETS ON CXX_EXTENSIONS OFF
    POSITION_INDEPENDENT_CODE ON)
  flyball_unity_groups(${target} ${arg_SOURCES})
  flyball_compile_options(${target})
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  install(TARGETS ${target} EXPORT Flyball_${name} FILE_SET HEADERS)
  set(uses ${arg_PUBLIC} ${arg_PRIVATE})  # A static library needs its private ones to be linked.
  list(FILTER uses INCLUDE REGEX "^flyball::")
  list(TRANSFORM uses REPLACE "^flyball::" "")
  flyball_component(${name} ${uses})
endfunction()

# flyball_unity_groups(<target> <source>...): which sources are compiled as one where CMAKE_UNITY_BUILD is on
# (everywhere but in the presets `dev` and `fuzz`: headers take most of the time): neighbours, so that a new file moves
# no file of another folder. Their names without linkage must differ.
function(flyball_unity_groups target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "in_${folder}" group)
    if(NOT count_${group})
      set(count_${group} 0)
    endif()
    math(EXPR part "${count_${group}} / 16")
    math(EXPR count_${group} "${count_${group}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
endfunction()

# flyball_component(<name> <component>...): installed, it can be found, with those that it uses.
function(flyball_component name)
  set_property(GLOBAL APPEND PROPERTY FLYBALL_COMPONENTS ${name})
  set_property(GLOBAL PROPERTY FLYBALL_USES_${name} "${ARGN}")
endfunction()

# flyball_loaded_module(<name> SOURCES ... LINKS <libraries>)
#   lib/flyball/<name>.so, for what kernels/include/flyball/kernels/module.h loads when it is wanted.
function(flyball_loaded_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  set(target flyball_${name})
  add_library(${target} MODULE ${arg_SOURCES})
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name} CXX_EXTENSIONS OFF
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/flyball)
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_link_libraries(${target} PRIVATE ${arg_LINKS})
  flyball_compile_options(${target})
  install(TARGETS ${target} LIBRARY DESTINATION lib/flyball COMPONENT tools)
endfunction()

# flyball_plugins(<target> <table> <file>...)
#   Compiles each plug-in file into <target> and generates <table>.cpp, which calls every
#   FLYBALL_PLUGIN(<stem>) in name order. A file may open with
#     // flyball-package: <CMake package>     (skipped, with a message, when not found)
#     // flyball-link:    <target>...
function(flyball_plugins target table)
  set(stems "")
  set(alone "")  # Those that need no package.
  flyball_unity_groups(${target} ${ARGN})
  list(SORT ARGN)
  foreach(file IN LISTS ARGN)
    cmake_path(GET file STEM stem)
    file(STRINGS ${file} package REGEX "^// flyball-package:")
    file(STRINGS ${file} links REGEX "^// flyball-link:")
    string(REGEX REPLACE "^// flyball-package: *" "" package "${package}")
    string(REGEX REPLACE "^// flyball-link: *" "" links "${links}")
    separate_arguments(links)
    if(package)
      separate_arguments(package)
      list(GET package 0 name)
      find_package(${package} QUIET)
      if(NOT ${name}_FOUND)
        message(STATUS "Flyball: ${stem} left out (${name} not found)")
        continue()
      endif()
      list(JOIN package " " package)
      string(REPLACE "flyball_" "" component ${target})
      flyball_needs(${component} "find_dependency(${package})")
    endif()
    target_sources(${target} PRIVATE ${file})
    target_link_libraries(${target} PRIVATE ${links})
    list(APPEND stems ${stem})
    if(NOT package)
      list(APPEND alone ${stem})
    endif()
  endforeach()
  flyball_plugin_table(${target} ${table} ${stems})
  set_target_properties(${target} PROPERTIES FLYBALL_SELF_CONTAINED_PLUGINS "${alone}")
endfunction()

# flyball_plugin_table(<target> <table> <stem>...): the function <table>, which calls these plug-ins.
function(flyball_plugin_table target table)
  set(decls "")
  set(calls "")
  foreach(stem IN LISTS ARGN)
    string(APPEND decls "void flyball_plugin_${stem}(flyball::Registry&);\n")
    string(APPEND calls "  flyball_plugin_${stem}(registry);\n")
  endforeach()
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${table}.cpp)
  file(CONFIGURE OUTPUT ${out} @ONLY CONTENT
"#include <flyball/runtime/registry.h>
extern \"C\" {
@decls@}
namespace flyball {
void @table@([[maybe_unused]] Registry& registry) {
@calls@}
}
")
  target_sources(${target} PRIVATE ${out})
endfunction()

# The part of the package file that finds one component: its dependencies on this machine, its target.
function(flyball_component_block component block)
  get_property(needs GLOBAL PROPERTY FLYBALL_NEEDS_${component})
  list(REMOVE_DUPLICATES needs)
  list(JOIN needs "\n  " needs)
  set(${block} "if(\"${component}\" IN_LIST _flyball_wanted)
  ${needs}
  include(\${CMAKE_CURRENT_LIST_DIR}/FlyballTargets_${component}.cmake)
  set(Flyball_${component}_FOUND TRUE)
endif()\n" PARENT_SCOPE)
endfunction()

function(flyball_install_package)
  include(CMakePackageConfigHelpers)
  set(dir ${CMAKE_INSTALL_LIBDIR}/cmake/Flyball)
  get_property(components GLOBAL PROPERTY FLYBALL_COMPONENTS)  # From the lowest layer up.
  set(FLYBALL_USES "")
  set(FLYBALL_BLOCKS "")
  foreach(component IN LISTS components)
    get_property(uses GLOBAL PROPERTY FLYBALL_USES_${component})
    string(APPEND FLYBALL_USES "set(_flyball_uses_${component} ${uses})\n")
    flyball_component_block(${component} block)
    string(APPEND FLYBALL_BLOCKS "${block}")
    install(EXPORT Flyball_${component} NAMESPACE flyball:: FILE FlyballTargets_${component}.cmake
            DESTINATION ${dir})
  endforeach()
  list(JOIN components " " FLYBALL_COMPONENTS)
  configure_package_config_file(runtime/cmake/FlyballConfig.cmake.in FlyballConfig.cmake INSTALL_DESTINATION ${dir})
  write_basic_package_version_file(FlyballConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/FlyballConfig.cmake ${PROJECT_BINARY_DIR}/FlyballConfigVersion.cmake DESTINATION ${dir})
  if(FLYBALL_BUILD_SIM)
    install(FILES runtime/cmake/FlyballOmpl.cmake DESTINATION ${dir})
  endif()
endfunction()
