# The packages behind the kernels and the simulator, as imported targets. An installed Flyball looks
# for the same ones.
foreach(package "octomap" "embree 3" "Simbody" "SQLite3" "assimp" "PNG" "mrpt-graphslam"
        "OpenCV COMPONENTS core imgproc features2d calib3d video")
  set_property(GLOBAL APPEND PROPERTY FLYBALL_DEPENDENCIES "find_dependency(${package})")
  separate_arguments(package)
  find_package(${package} REQUIRED)
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/FlyballOmpl.cmake)
set_property(GLOBAL APPEND PROPERTY FLYBALL_DEPENDENCIES
             "include(\${CMAKE_CURRENT_LIST_DIR}/FlyballOmpl.cmake)")
