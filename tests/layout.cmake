cmake_minimum_required(VERSION 3.25)
# Fails when the tree leaves its plan: a folder at the top that has no place there, a source file
# without its test, a file that is too long.
set(places runtime governors kernels apps sim policies tests examples)
set(built build flights)  # what the commands leave, not under version control
set(bad "")

file(GLOB top LIST_DIRECTORIES true RELATIVE ${root} ${root}/*)
list(FILTER top EXCLUDE REGEX "^\\.")
foreach(entry IN LISTS top)
  if(IS_DIRECTORY ${root}/${entry} AND NOT entry IN_LIST places AND NOT entry IN_LIST built)
    string(APPEND bad "\n  ${entry}/: no such folder is planned at the top")
  endif()
endforeach()

# A file that is tested through another one says so in a line `// tested-in: <stem>`. Plug-ins stand
# outside src/ or in a folder below it: the conformance tests run each of them.
foreach(folder IN LISTS places)
  file(GLOB sources ${root}/${folder}/src/*.cpp)
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM stem)
    file(STRINGS ${source} other REGEX "^// tested-in: [a-z0-9_]+$" LIMIT_COUNT 1)
    if(other)
      string(REPLACE "// tested-in: " "" stem "${other}")
    endif()
    if(NOT EXISTS ${root}/tests/${folder}/${stem}_test.cpp)
      string(APPEND bad "\n  ${source}: tests/${folder}/${stem}_test.cpp is missing")
    endif()
  endforeach()
endforeach()

foreach(folder IN LISTS places)
  file(GLOB_RECURSE files ${root}/${folder}/*.h ${root}/${folder}/*.cpp ${root}/${folder}/*.cmake
       ${root}/${folder}/*.sh ${root}/${folder}/*.js ${root}/${folder}/*.html)
  foreach(file IN LISTS files)
    file(READ ${file} text)
    string(REGEX REPLACE "[^\n]" "" text "${text}")
    string(LENGTH "${text}" lines)
    if(lines GREATER 300)
      string(APPEND bad "\n  ${file}: ${lines} lines, at most 300")
    endif()
  endforeach()
endforeach()

if(bad)
  message(FATAL_ERROR "against the plan of the tree:${bad}")
endif()
