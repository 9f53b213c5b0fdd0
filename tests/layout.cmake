cmake_minimum_required(VERSION 3.25)
# Fails when the tree leaves its plan: a folder at the top that has no place there, a source file
# without its test, a file that is too long, a static that changes.
set(places runtime governors kernels apps sim policies tests examples)
set(built build flights)  # what the commands leave, not under version control
set(bad "")

# forbid(PATTERN SENTENCE FILE...): no line of these files matches.
function(forbid pattern sentence)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} lines REGEX "${pattern}")
    if(lines)
      string(APPEND bad "\n  ${file}: ${sentence}: ${lines}")
    endif()
  endforeach()
  set(bad "${bad}" PARENT_SCOPE)
endfunction()

file(GLOB top LIST_DIRECTORIES true RELATIVE ${root} ${root}/*)
list(FILTER top EXCLUDE REGEX "^\\.")
foreach(entry IN LISTS top)
  if(IS_DIRECTORY ${root}/${entry} AND NOT entry IN_LIST places AND NOT entry IN_LIST built)
    string(APPEND bad "\n  ${entry}/: no such folder is planned at the top")
  endif()
endforeach()

# A file that is tested through another one says so in a line `// tested-in: <stem>`. Plug-ins need
# no test of their own: the conformance tests run each of them, and all_experiments_test.cpp plans each
# experiment. The commands are tested as programs.
foreach(folder IN LISTS places)
  file(GLOB_RECURSE tests ${root}/tests/${folder}/*_test.cpp)
  list(TRANSFORM tests REPLACE ".*/" "")
  if(folder STREQUAL "apps")
    file(GLOB_RECURSE sources ${root}/apps/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/apps/(cli|workloads|records/picture_reader)/|/apps/experiments/[a-z0-9_]+[.]cpp$")
  elseif(folder STREQUAL "policies")
    # Beside <name>/<name>.cpp, the plug-in, stand the parts of it.
    file(GLOB sources ${root}/policies/*/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/([a-z0-9_]+)/\\1\\.cpp$")
  else()
    file(GLOB_RECURSE sources ${root}/${folder}/src/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/src/worlds/")
  endif()
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM stem)
    file(STRINGS ${source} other REGEX "^// tested-in: [a-z0-9_]+$" LIMIT_COUNT 1)
    if(other)
      string(REPLACE "// tested-in: " "" stem "${other}")
    endif()
    if(NOT ${stem}_test.cpp IN_LIST tests)
      string(APPEND bad "\n  ${source}: ${stem}_test.cpp is missing in tests/${folder}")
    endif()
  endforeach()
endforeach()

# A folder with more files than this has rooms that nobody has found yet.
set(most_files 40)
foreach(folder IN LISTS places)
  file(GLOB_RECURSE files RELATIVE ${root} ${root}/${folder}/*.h ${root}/${folder}/*.cpp
       ${root}/${folder}/*.inc ${root}/${folder}/*.lua)
  list(TRANSFORM files REPLACE "/[^/]*$" "")
  set(rooms ${files})
  list(REMOVE_DUPLICATES rooms)
  foreach(room IN LISTS rooms)
    set(held ${files})
    list(FILTER held INCLUDE REGEX "^${room}$")
    list(LENGTH held count)
    if(count GREATER most_files)
      string(APPEND bad "\n  ${room}/: ${count} files of code, at most ${most_files}")
    endif()
  endforeach()
endforeach()

foreach(folder IN LISTS places)
  file(GLOB_RECURSE files ${root}/${folder}/*.h ${root}/${folder}/*.cpp ${root}/${folder}/*.inc
       ${root}/${folder}/*.py ${root}/${folder}/*.lua ${root}/${folder}/*.cmake
       ${root}/${folder}/*.sh ${root}/${folder}/*.js ${root}/${folder}/*.html)
  foreach(file IN LISTS files)
    file(READ ${file} text)
    string(REGEX REPLACE "[^\n]" "" text "${text}")
    string(LENGTH "${text}" lines)
    if(lines GREATER 400)
      string(APPEND bad "\n  ${file}: ${lines} lines, at most 400")
    endif()
  endforeach()
endforeach()

# State that all callers of a function share and that may change. (clang-tidy looks for that of a file.)
foreach(folder IN ITEMS runtime governors kernels policies sim apps)
  file(GLOB_RECURSE files ${root}/${folder}/*.h ${root}/${folder}/*.cpp ${root}/${folder}/*.inc)
  foreach(file IN LISTS files)
    file(STRINGS ${file} lines REGEX "^ +(thread_local )?static [^(]*[;={]")
    foreach(line IN LISTS lines)
      if(NOT line MATCHES "static (inline )?const(expr)? ")
        string(APPEND bad "\n  ${file}: a static that changes:${line}")
      endif()
    endforeach()
  endforeach()
endforeach()

# Timed condition variables follow the wall clock with older C libraries, and come tens of
# milliseconds late where the kernel's timers do not: what flies waits by a futex (`Parking`).
foreach(folder IN ITEMS runtime governors policies kernels apps/flight apps/workloads
        apps/mcap)
  file(GLOB_RECURSE files ${root}/${folder}/*.h ${root}/${folder}/*.cpp)
  forbid("condition_variable|pthread_cond_timedwait|future.*wait_(for|until)"
         "waits by a condition variable" ${files})
endforeach()

# OpenCV's thread count is set under a lock that spins, which one job must not hold while another one
# waits: not in a job, so not beside what kernels do in one.
file(GLOB_RECURSE files ${root}/kernels/*.h ${root}/kernels/*.cpp)
list(FILTER files EXCLUDE REGEX "/cv_threads[.]h$")
forbid("setNumThreads" "sets OpenCV's threads itself, not by cv_threads.h" ${files})

# Two types of one name in two headers: the linker keeps one of their destructors for both.
set(types "")
foreach(folder IN ITEMS runtime governors policies kernels sim apps)
  file(GLOB_RECURSE files ${root}/${folder}/*.h)
  foreach(file IN LISTS files)
    file(STRINGS ${file} own REGEX "^(struct|class|enum class) [A-Za-z0-9]+ ?(final )?(: [^;]*)?{")
    list(TRANSFORM own REPLACE "^(struct|enum class|class) ([A-Za-z0-9]+).*" "\\2")
    list(REMOVE_DUPLICATES own)  # One of two, by the preprocessor.
    foreach(type IN LISTS own)
      if(type IN_LIST types)
        string(APPEND bad "\n  ${file}: another header has a type ${type}, too")
      endif()
    endforeach()
    list(APPEND types ${own})
  endforeach()
endforeach()

if(bad)
  message(FATAL_ERROR "against the plan of the tree:${bad}")
endif()
