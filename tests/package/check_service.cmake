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
