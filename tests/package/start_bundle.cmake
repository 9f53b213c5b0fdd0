cmake_minimum_required(VERSION 3.25)
# The command with libraries of its own starts where there is nothing else: no library, no shell, no
# /proc.
set(folder ${built}/package/bundle)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder}/root/tmp)

execute_process(COMMAND ${CMAKE_COMMAND} -D built=${built} -D out=${folder}/root/opt/flyball -P
                        ${CMAKE_CURRENT_LIST_DIR}/../../runtime/cmake/bundle.cmake COMMAND_ERROR_IS_FATAL ANY)
# With the licences of what is in it: this program's, libraries', headers'.
set(licences ${folder}/root/opt/flyball/share/doc/flyball/copyright)
find_program(dpkg_query dpkg-query)
if(dpkg_query)
  foreach(package libc6 libsimbody3.7 libgomp1 libeigen3-dev)
    if(EXISTS /usr/share/doc/${package}/copyright)
      list(APPEND licences ${folder}/root/opt/flyball/share/doc/${package}/copyright)
    endif()
  endforeach()
endif()
foreach(licence IN LISTS licences)
  if(NOT EXISTS ${licence})
    message(FATAL_ERROR "the bundle lacks ${licence}")
  endif()
endforeach()
set(inside unshare --map-root-user --root=${folder}/root)
execute_process(COMMAND ${inside} /opt/flyball/bin/flyball version RESULT_VARIABLE failed
                OUTPUT_VARIABLE said ERROR_VARIABLE why)
if(why MATCHES "^unshare: ")  # Nobody may make such a root here.
  message("${why}")
  return()
endif()
if(failed OR NOT said MATCHES "^flyball [0-9]")
  message(FATAL_ERROR "flyball version: ${failed} ${said}${why}")
endif()
# Its own processes are started in the same way.
execute_process(COMMAND ${inside} /opt/flyball/bin/flyball compare delivery_open --policies fixed_fine
                        --set mission.time_limit_s=3 --out /tmp/flights
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE why)
if(NOT said MATCHES "fixed_fine .*time_limit")
  message(FATAL_ERROR "flyball compare: ${failed} ${said}${why}")
endif()
file(REMOVE_RECURSE ${folder})
