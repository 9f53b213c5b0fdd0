# Programs that measure.
if(FLYBALL_BUILD_SIM)
  add_executable(kernel_costs EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/kernel_costs.cpp)
  target_link_libraries(kernel_costs PRIVATE flyball::apps octomap octomath)
  target_include_directories(kernel_costs PRIVATE ${PROJECT_SOURCE_DIR}/apps/src)
  flyball_compile_options(kernel_costs)
endif()
find_package(benchmark QUIET)
if(FLYBALL_BUILD_SIM AND benchmark_FOUND)
  set(here ${CMAKE_CURRENT_LIST_DIR})
  add_executable(map_bench ${here}/map_bench.cpp ${here}/map_pipeline.cpp ${here}/map_questions.cpp
                           ${here}/map_scenes.cpp ${here}/map_table.cpp)
  target_link_libraries(map_bench PRIVATE flyball::kernels octomap octomath benchmark::benchmark)
  target_include_directories(map_bench PRIVATE ${PROJECT_SOURCE_DIR}/kernels/src)
  flyball_compile_options(map_bench)
  # It measures nothing worth knowing, but runs all of it, and fails where stock answers otherwise.
  add_test(NAME map_bench COMMAND map_bench --small --table=${PROJECT_BINARY_DIR}/map_bench_small.md)
  set_tests_properties(map_bench PROPERTIES LABELS unit TIMEOUT 300)
endif()
