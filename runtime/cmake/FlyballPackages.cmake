# The packages behind the kernels and the simulator, as imported targets. An installed Flyball looks
# for the same ones, each for the components that it stands before.
foreach(line "kernels: OpenCV COMPONENTS core imgproc features2d calib3d video" "kernels: mrpt-graphslam"
        "kernels sim: octomap" "sim: embree 3" "sim: Simbody" "sim: assimp" "sim records recordings: PNG"
        "mcap: zstd" "studies: SQLite3")
  string(REGEX MATCH "^(.*): (.*)$" line "${line}")
  set(components ${CMAKE_MATCH_1})
  set(package ${CMAKE_MATCH_2})
  separate_arguments(components)
  foreach(component IN LISTS components)
    flyball_needs(${component} "find_dependency(${package})")
  endforeach()
  separate_arguments(package)
  find_package(${package} REQUIRED)
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/FlyballOmpl.cmake)
flyball_needs(kernels "include(\${CMAKE_CURRENT_LIST_DIR}/FlyballOmpl.cmake)")
