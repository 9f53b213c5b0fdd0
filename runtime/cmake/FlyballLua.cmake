# Lua 5.4 as the target flyball_lua: CMake's own module knows the versions up to 5.3's names only.
# No target when it is not there: policies can then not be Lua scripts.
if(TARGET flyball_lua)
  return()
endif()
find_path(FLYBALL_LUA_INCLUDE lua.h PATH_SUFFIXES lua5.4 lua-5.4 lua54)
find_library(FLYBALL_LUA_LIBRARY NAMES lua5.4 lua-5.4 lua54)
mark_as_advanced(FLYBALL_LUA_INCLUDE FLYBALL_LUA_LIBRARY)
if(FLYBALL_LUA_INCLUDE AND FLYBALL_LUA_LIBRARY)
  add_library(flyball_lua INTERFACE IMPORTED GLOBAL)
  target_include_directories(flyball_lua SYSTEM INTERFACE ${FLYBALL_LUA_INCLUDE})
  target_link_libraries(flyball_lua INTERFACE ${FLYBALL_LUA_LIBRARY})
endif()
