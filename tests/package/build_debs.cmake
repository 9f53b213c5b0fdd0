cmake_minimum_required(VERSION 3.25)
# The Debian packages of this build: what is in them, on what they depend, and whether the command runs
# from where they are unpacked.
set(folder ${built}/package/debs)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder}/root)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${text}")
  endif()
  set(said "${text}" PARENT_SCOPE)
endfunction()

function(expect text pattern what)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "${what} has nothing like \"${pattern}\":\n${text}")
  endif()
endfunction()

function(refuse text pattern what)
  if(text MATCHES "${pattern}")
    message(FATAL_ERROR "${what} has \"${CMAKE_MATCH_0}\":\n${text}")
  endif()
endfunction()

# Packages whose dependencies nobody can tell are not made.
execute_process(COMMAND ${CMAKE_CPACK_COMMAND} --config ${built}/CPackConfig.cmake -B ${folder}/none
                        -D CMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF -D CMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT failed)
  message(FATAL_ERROR "cpack makes packages without dpkg-shlibdeps:\n${said}")
endif()
expect("${said}" "there is no dpkg-shlibdeps here" "cpack without dpkg-shlibdeps")

# This build was not made for /usr; what lies where beneath it is the same.
run(${CMAKE_CPACK_COMMAND} --config ${built}/CPackConfig.cmake -B ${folder}
    -D CPACK_PACKAGING_INSTALL_PREFIX=/usr -D CPACK_DEBIAN_COMPRESSION_TYPE=zstd)

# package(<name>): `depends`, `recommends` and `files` of its package, which is unpacked.
function(package name)
  file(GLOB deb ${folder}/${name}_*.deb)
  list(LENGTH deb count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "there are ${count} packages ${name}_*.deb in ${folder}")
  endif()
  run(dpkg-deb -f ${deb} Depends)
  set(depends "${said}" PARENT_SCOPE)
  run(dpkg-deb -f ${deb} Recommends)
  set(recommends "${said}" PARENT_SCOPE)
  run(dpkg-deb -c ${deb})
  set(files "${said}" PARENT_SCOPE)
  run(dpkg-deb -x ${deb} ${folder}/root)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${flyball}/LICENSE ${folder}/root/usr/share/doc/${name}/copyright
                  RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${name} has no share/doc/${name}/copyright with the licence")
  endif()
endfunction()

package(libflyball-governor0)
# What package.governor holds the library to, where it is linked so; else what dpkg-shlibdeps found.
run(uname -m)
if(said MATCHES "^(x86_64|aarch64)$")
  expect("${depends}" "libc6 \\(>= 2\\.27\\)" "libflyball-governor0's Depends")
else()
  expect("${depends}" "libc6 " "libflyball-governor0's Depends")
endif()
refuse("${depends}" "libstdc|opencv|octomap|ompl|lua" "libflyball-governor0's Depends")
expect("${files}" "/libflyball_governor\\.so\\.0" "libflyball-governor0")
refuse("${files}" "\\.h\n|/bin/" "libflyball-governor0")

package(libflyball-dev)
expect("${depends}" "libflyball-governor0 \\(= " "libflyball-dev's Depends")
expect("${files}" "/include/flyball/governors/governor\\.h" "libflyball-dev")
expect("${files}" "/libflyball_runtime\\.a" "libflyball-dev")
expect("${files}" "/cmake/Flyball/FlyballConfig\\.cmake" "libflyball-dev")
# What the governors and policies look for is there wherever the package is.
file(GLOB_RECURSE config ${folder}/root/usr/lib/FlyballConfig.cmake)
file(READ ${config} config)
expect("${depends}" "libeigen3-dev" "libflyball-dev's Depends")
if(config MATCHES "find_dependency\\(NLopt")
  expect("${depends}" "libnlopt-dev" "libflyball-dev's Depends")
endif()

package(flyball-data)
expect("${files}" "/share/flyball/boards/.*\\.toml" "flyball-data")
expect("${files}" "/share/flyball/presets/.*\\.toml" "flyball-data")
if(NOT sim)
  return()
endif()

package(flyball)
expect("${depends}" "flyball-data \\(= " "flyball's Depends")
expect("${recommends}" "morse-simulator-data" "flyball's Recommends")
expect("${files}" "/usr/lib/systemd/system/flyball@\\.service" "flyball")
refuse("${files}" "\\.wants/" "flyball")  # It starts when somebody says so.
foreach(library liboctomap libompl libopencv-core libmrpt libsimtk|libsimbody libembree libassimp)
  expect("${depends}" "${library}" "flyball's Depends")
endforeach()
run(${folder}/root/usr/bin/flyball list scenarios)
expect("${said}" "delivery_forest" "what the unpacked command lists")
