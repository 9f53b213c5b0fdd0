# What another library for MAVLink is shown, by check.sh alone.
if(FLYBALL_BUILD_SIM)
  add_executable(mavlink_samples EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/mavlink_samples.cpp)
  target_include_directories(mavlink_samples PRIVATE ${CMAKE_CURRENT_LIST_DIR}/../kit ${PROJECT_SOURCE_DIR}/apps)
  target_link_libraries(mavlink_samples PRIVATE flyball::vehicles flyball::scenario flyball::sim)
  flyball_compile_options(mavlink_samples)
endif()
