# What the command's package for 64-bit Arm depends on. dpkg-shlibdeps would need its libraries' packages
# installed on this machine; here the list does that arm64_sysroot.sh keeps: `LIBRARY VERSION PACKAGES` in a line.
# cpack reads this when it begins (CPACK_PROJECT_CONFIG_FILE).

# flyball_shlibs(<variable> <file>...): the packages of the libraries that these files link.
function(flyball_shlibs variable)
  file(STRINGS ${CPACK_FLYBALL_SYSROOT}/shlibs known REGEX "^[^ ]+ [^ ]+ [^ ]")
  set(packages "")
  foreach(file IN LISTS ARGN)
    execute_process(COMMAND objdump -p ${file} OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "NEEDED +[^ \n]+" libraries "${headers}")
    foreach(library IN LISTS libraries)
      string(REGEX REPLACE "NEEDED +" "" library "${library}")
      # libNAME-VERSION.so or libNAME.so.VERSION
      string(REGEX REPLACE "^(.*)-([0-9.]+)\\.so$" "\\1 \\2" line "${library}")
      string(REGEX REPLACE "^(.*)\\.so\\.([0-9.]+)$" "\\1 \\2" line "${line}")
      string(REGEX REPLACE "([+.])" "\\\\\\1" line "${line}")
      set(found ${known})
      list(FILTER found INCLUDE REGEX "^${line} ")
      if(NOT found)
        message(FATAL_ERROR "no package of ${CPACK_FLYBALL_SYSROOT} has ${library}, which ${file} links; make the "
                            "sysroot anew with runtime/cmake/arm64_sysroot.sh")
      endif()
      list(GET found 0 found)
      string(REGEX MATCH "^[^ ]+ [^ ]+ (.*)$" found "${found}")
      string(REPLACE ", " ";" found "${CMAKE_MATCH_1}")
      list(APPEND packages ${found})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES packages)
  list(SORT packages)
  list(JOIN packages ", " packages)
  set(${variable} "${packages}" PARENT_SCOPE)
endfunction()

set(built ${CPACK_FLYBALL_BUILT})
if(EXISTS ${built}/bin/flyball)
  file(GLOB modules ${built}/lib/flyball/*.so)
  flyball_shlibs(libraries ${built}/bin/flyball ${modules})
  string(APPEND CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS ", ${libraries}")
endif()
