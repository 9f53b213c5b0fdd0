# Programs that measure; nothing builds them unless asked.
if(FLYBALL_BUILD_SIM)
  add_executable(kernel_costs EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/kernel_costs.cpp)
  target_link_libraries(kernel_costs PRIVATE flyball::apps octomap octomath)
  target_include_directories(kernel_costs PRIVATE ${PROJECT_SOURCE_DIR}/apps/src)
  flyball_compile_options(kernel_costs)
endif()
if(FLYBALL_BUILD_SIM)
  add_executable(detector_recall EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/detector_recall.cpp)
  target_link_libraries(detector_recall PRIVATE flyball::apps)
  target_include_directories(detector_recall PRIVATE ${PROJECT_SOURCE_DIR}/apps/src)
  flyball_compile_options(detector_recall)
endif()
find_package(benchmark QUIET)
if(FLYBALL_BUILD_SIM AND benchmark_FOUND)
  add_executable(map_bench EXCLUDE_FROM_ALL
    ${CMAKE_CURRENT_LIST_DIR}/map_bench.cpp
    ${CMAKE_CURRENT_LIST_DIR}/map_scenes.cpp
    ${CMAKE_CURRENT_LIST_DIR}/map_table.cpp)
  target_link_libraries(map_bench PRIVATE flyball::kernels octomap octomath benchmark::benchmark)
  target_include_directories(map_bench PRIVATE ${PROJECT_SOURCE_DIR}/kernels/src)
  flyball_compile_options(map_bench)
endif()
