cmake_minimum_required(VERSION 3.25)
# Installs Flyball into a prefix of its own, builds somebody's policy and kernel against it in an empty
# folder, and lets the installed program check, fly and list them.
set(folder ${built}/package/policy)
file(REMOVE_RECURSE ${folder})
file(COPY ${source}/policy/ ${flyball}/examples/kernels/blue_trousers.cpp DESTINATION ${folder}/project)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${folder} RESULT_VARIABLE failed
                  OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(failed)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${text}")
  endif()
  set(said "${text}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${built} --prefix ${folder}/prefix)
run(${CMAKE_COMMAND} -S project -B build -G ${generator} -D CMAKE_PREFIX_PATH=${folder}/prefix
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_COMPILER_LAUNCHER=${launcher}
    -D CMAKE_BUILD_TYPE=${type})
run(${CMAKE_COMMAND} --build build)
run(prefix/bin/flyball policy check build/libmine.so)
if(NOT said MATCHES "keeps the contract of a policy")
  message(FATAL_ERROR "policy check says: ${said}")
endif()
run(prefix/bin/flyball compare delivery_forest --policies build/libmine.so,fixed_coarse --seeds 1..1
    --set world.generator=empty --set world.goal_distance_m=5 --set name=short
    --set camera.width_px=32 --set camera.height_px=18 --out flights)
foreach(name libmine fixed_coarse)
  if(NOT said MATCHES "${name}")
    message(FATAL_ERROR "${name} is not in the comparison: ${said}")
  endif()
endforeach()
run(prefix/bin/flyball list kernels --kernels build/libblue_trousers.so)
if(NOT said MATCHES "blue_trousers")
  message(FATAL_ERROR "the kernel is not in the list: ${said}")
endif()
