# The packages behind the kernels and the simulator, as imported targets.

find_package(embree 3 QUIET)
find_package(Simbody QUIET)
find_package(tomlplusplus QUIET)

# OMPL's own config file hard-codes Boost paths and makes no target.
find_path(FLYBALL_OMPL_INCLUDE ompl/config.h PATH_SUFFIXES ompl-1.5)
find_library(FLYBALL_OMPL_LIBRARY ompl)
mark_as_advanced(FLYBALL_OMPL_INCLUDE FLYBALL_OMPL_LIBRARY)
if(FLYBALL_OMPL_INCLUDE AND FLYBALL_OMPL_LIBRARY AND NOT TARGET flyball_ompl)
  add_library(flyball_ompl INTERFACE IMPORTED GLOBAL)
  target_include_directories(flyball_ompl SYSTEM INTERFACE ${FLYBALL_OMPL_INCLUDE})
  target_link_libraries(flyball_ompl INTERFACE ${FLYBALL_OMPL_LIBRARY})
endif()
