# A tarball with the command `flyball`, its data, and every library that it needs, the C library and
# its loader among them: for boards whose system is older than the one that it was built on.
#
#     cmake -D built=build/package -D out=flyball.tar.gz -P runtime/cmake/bundle.cmake
#
# From a build with the preset `arm64`, add `-D sysroot=build/arm64-sysroot`. Where `out` does not end in
# .tar.gz it is a folder.
cmake_minimum_required(VERSION 3.25)
foreach(need built out)
  if(NOT DEFINED ${need})
    message(FATAL_ERROR "say -D ${need}=...; the head of ${CMAKE_CURRENT_LIST_FILE} shows how")
  endif()
endforeach()
file(REAL_PATH "${built}" built)
cmake_path(ABSOLUTE_PATH out)
set(stage ${built}/bundle)
set(root ${out})
if(out MATCHES "/([^/]+)\\.tar\\.gz$")
  set(name ${CMAKE_MATCH_1})
  set(root ${stage}/${name})
  file(REMOVE_RECURSE ${stage})
elseif(EXISTS ${out})
  message(FATAL_ERROR "\"${out}\" exists; remove it, or give another -D out=")
endif()

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()
run(${CMAKE_COMMAND} --install ${built} --component tools --prefix ${root} --strip)
run(${CMAKE_COMMAND} --install ${built} --component data --prefix ${root})
if(NOT EXISTS ${root}/bin/flyball)
  message(FATAL_ERROR "${built} has no command flyball; it was configured with FLYBALL_BUILD_SIM=OFF")
endif()

# Of the host, what CMake finds itself; of another architecture, beneath its root.
if(DEFINED sysroot)
  file(REAL_PATH "${sysroot}" sysroot)
  set(CMAKE_GET_RUNTIME_DEPENDENCIES_PLATFORM linux+elf)
  set(CMAKE_GET_RUNTIME_DEPENDENCIES_TOOL objdump)
  file(GLOB folders LIST_DIRECTORIES true ${sysroot}/lib/*-linux-gnu ${sysroot}/usr/lib ${sysroot}/usr/lib/*-linux-gnu
       ${sysroot}/usr/lib/*-linux-gnu/blas ${sysroot}/usr/lib/*-linux-gnu/lapack)
endif()
file(GLOB modules ${root}/lib/flyball/*.so)
file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${root}/bin/flyball MODULES ${modules}
     RESOLVED_DEPENDENCIES_VAR libraries UNRESOLVED_DEPENDENCIES_VAR missing DIRECTORIES ${folders})
if(missing)
  message(FATAL_ERROR "these libraries are nowhere: ${missing}")
endif()

# bundle_licence(<package>): what its authors ask to go with copies, as far as it is on this machine.
function(bundle_licence package)
  set(file ${sysroot}/usr/share/doc/${package}/copyright)
  if(EXISTS ${file})
    file(REAL_PATH ${file} real)
    file(MAKE_DIRECTORY ${root}/share/doc/${package})
    file(COPY_FILE ${real} ${root}/share/doc/${package}/copyright)
  endif()
endfunction()

# bundle_licence_of(<library>...): those of the packages that have these files. Some of Debian's packages
# name them below /lib, others below /usr/lib.
function(bundle_licence_of)
  find_program(dpkg_query dpkg-query NO_CACHE)
  if(NOT dpkg_query)
    return()
  endif()
  set(names "")
  foreach(library IN LISTS ARGN)
    file(REAL_PATH ${library} real)
    string(REGEX REPLACE "^/usr/" "/" short "${real}")
    list(APPEND names ${real} ${short})
  endforeach()
  execute_process(COMMAND ${dpkg_query} --search ${names} OUTPUT_VARIABLE found ERROR_QUIET)
  string(REGEX MATCHALL "[^\n:]+:[^\n]*" found "${found}")
  list(TRANSFORM found REPLACE ":.*" "")
  list(REMOVE_DUPLICATES found)
  foreach(package IN LISTS found)
    bundle_licence(${package})
  endforeach()
endfunction()

# Beneath a root packages were unpacked only, so that nobody knows whose a file is: all of them.
if(DEFINED sysroot)
  file(GLOB packages RELATIVE ${sysroot}/usr/share/doc ${sysroot}/usr/share/doc/*)
else()
  bundle_licence_of(${libraries})
  set(packages libcli11-dev libeigen3-dev libtomlplusplus-dev nlohmann-json3-dev)  # Headers, compiled in.
endif()
foreach(package IN LISTS packages)
  bundle_licence(${package})
endforeach()
# Where they speak of the GPL and its like, they name these.
if(EXISTS ${sysroot}/usr/share/common-licenses)
  file(COPY ${sysroot}/usr/share/common-licenses DESTINATION ${root}/share)
endif()

file(MAKE_DIRECTORY ${root}/lib/bundle)
foreach(library IN LISTS libraries)
  cmake_path(GET library FILENAME file)
  file(REAL_PATH ${library} real)
  file(COPY_FILE ${real} ${root}/lib/bundle/${file})
  if(file MATCHES "^ld-linux")
    file(RENAME ${root}/lib/bundle/${file} ${root}/lib/bundle/loader)
    file(CREATE_LINK loader ${root}/lib/bundle/${file} SYMBOLIC)
  endif()
endforeach()
if(NOT EXISTS ${root}/lib/bundle/loader)
  message(FATAL_ERROR "no ld-linux*.so among the libraries of ${root}/bin/flyball")
endif()
file(RENAME ${root}/bin/flyball ${root}/lib/bundle/flyball)
file(COPY_FILE ${built}/bin/flyball_launcher ${root}/bin/flyball)
file(CHMOD ${root}/bin/flyball PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
     WORLD_READ WORLD_EXECUTE)
if(DEFINED name)
  run(tar -C ${stage} --owner=0 --group=0 --numeric-owner --sort=name --mtime=@0 -czf ${out} ${name})
  file(REMOVE_RECURSE ${stage})
endif()
