cmake_minimum_required(VERSION 3.25)
# The unit of systemd is one that systemd understands, with the command of this build in it.
set(folder ${built}/package/service)
file(REMOVE_RECURSE ${folder})
file(READ ${flyball}/apps/cli/service/flyball@.service unit)
string(REGEX REPLACE "(Exec[A-Za-z]+=[+]?)flyball " "\\1${built}/bin/flyball " unit "${unit}")
file(WRITE ${folder}/flyball@.service "${unit}")
# An instance is a file of its own for the checker.
file(CREATE_LINK ${folder}/flyball@.service ${folder}/flyball@delivery_forest.service SYMBOLIC)
execute_process(COMMAND ${analyze} verify --man=no ${folder}/flyball@delivery_forest.service
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed OR said)
  message(FATAL_ERROR "systemd-analyze verify: ${failed}\n${said}")
endif()

# setting(<name>): `value`, what the unit says behind it, or nothing.
function(setting name)
  set(value "")
  if(unit MATCHES "\n${name}=([^\n]*)")
    set(value "${CMAKE_MATCH_1}")
  endif()
  set(value "${value}" PARENT_SCOPE)
endfunction()

# Of a dynamic user systemd makes the group, too, and refuses when there is one of that name: the setup
# makes those of SupplementaryGroups=. Without User= it takes the unit's name up to the @.
setting(DynamicUser)
set(dynamic ${value})
setting(SupplementaryGroups)
string(REPLACE " " ";" groups "${value}")
setting(User)
if(dynamic AND (value STREQUAL "" OR value IN_LIST groups))
  message(FATAL_ERROR "DynamicUser=yes with User=${value} cannot start where there is a group \"flyball\"; "
                      "give User= a name that no group has")
endif()

# A flight that was asked to end is not killed while its vehicle lands.
file(READ ${flyball}/apps/vehicles/autopilot_link.cpp link)
if(NOT link MATCHES "landed_within = ([0-9]+)min;")
  message(FATAL_ERROR "apps/vehicles/autopilot_link.cpp does not say how long a landing may take")
endif()
math(EXPR landing "60 * ${CMAKE_MATCH_1}")
setting(TimeoutStopSec)
if(NOT value GREATER landing)
  message(FATAL_ERROR "TimeoutStopSec=${value} kills a flight that may take ${landing} s to land")
endif()

# `systemctl enable` makes the link that starts it with the board.
set(root ${folder}/root)
file(COPY ${flyball}/apps/cli/service/flyball@.service DESTINATION ${root}/usr/lib/systemd/system)
execute_process(COMMAND systemctl --root=${root} enable flyball@delivery_forest.service
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed OR NOT IS_SYMLINK ${root}/etc/systemd/system/multi-user.target.wants/flyball@delivery_forest.service)
  message(FATAL_ERROR "systemctl enable: ${failed}, and no link in multi-user.target.wants\n${said}")
endif()

# The guide takes away each file that the setup writes.
execute_process(COMMAND ${built}/bin/flyball board setup --print OUTPUT_VARIABLE setup COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "> /etc/[^ \n]+" written "${setup}")
list(TRANSFORM written REPLACE "^> " "")
file(READ ${flyball}/runtime/boards/GUIDE.md guide)
if(guide MATCHES "\\]\\([^)]*\\)")
  message(FATAL_ERROR "the guide is installed alone, so that its link \"${CMAKE_MATCH_0}\" leads nowhere")
endif()
if(NOT written)
  message(FATAL_ERROR "the setup writes no file below /etc:\n${setup}")
endif()
foreach(file IN LISTS written)
  if(NOT guide MATCHES "sudo rm -f[^\n]* ${file}[ \n]")
    message(FATAL_ERROR "step 9 of runtime/boards/GUIDE.md does not remove ${file}, which the setup writes")
  endif()
endforeach()
