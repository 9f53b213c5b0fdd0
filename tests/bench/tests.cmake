# Programs that measure; nothing builds them unless asked.
if(FLYBALL_BUILD_SIM)
  add_executable(kernel_costs EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/kernel_costs.cpp)
  target_link_libraries(kernel_costs PRIVATE flyball::apps octomap octomath)
  target_include_directories(kernel_costs PRIVATE ${PROJECT_SOURCE_DIR}/apps/src)
  flyball_compile_options(kernel_costs)
endif()
