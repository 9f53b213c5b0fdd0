# Builds for 64-bit Arm boards with Debian's cross compiler, against the sysroot that
# arm64_sysroot.sh makes: build/arm64-sysroot, or where FLYBALL_ARM64_SYSROOT says. Tests run under
# qemu, as the processor of a Jetson TX2 or an older board would run them.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
if(DEFINED ENV{FLYBALL_ARM64_SYSROOT})
  set(CMAKE_SYSROOT "$ENV{FLYBALL_ARM64_SYSROOT}")
else()
  cmake_path(SET CMAKE_SYSROOT NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../../build/arm64-sysroot")
endif()
if(NOT EXISTS ${CMAKE_SYSROOT}/.complete)
  message(FATAL_ERROR "no complete sysroot in \"${CMAKE_SYSROOT}\": make it with runtime/cmake/arm64_sysroot.sh, "
                      "or name one in FLYBALL_ARM64_SYSROOT")
endif()
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(libraries ${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-rpath-link,${libraries}:${CMAKE_SYSROOT}/lib/aarch64-linux-gnu")
set(CMAKE_CROSSCOMPILING_EMULATOR
    "qemu-aarch64-static;-cpu;cortex-a57;-L;${CMAKE_SYSROOT}")
