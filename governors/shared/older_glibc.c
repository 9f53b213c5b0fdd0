/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Lets libflyball_governor load where the C library is older than the one it is linked with, down to
 * 2.27 of JetPack 4 (package.governor checks that). The linker takes the newest version of a function,
 * and these got a new one later: exp, log and pow lost a wrapper for errors in 2.29, what was in libdl
 * and libpthread moved into libc in 2.34, hypot became faster in 2.35. Each name is defined here, seen
 * inside of the library alone, as a jump to the version that has been there all along. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/random.h>
#include <sys/stat.h>

#if defined(__x86_64__)
#define FIRST_VERSION "GLIBC_2.2.5"
#define PROTOCOL_VERSION "GLIBC_2.4"
#define JUMP_TO(name) "jmp " name "@PLT"
#define STAT_VERSION 1
#else
#define FIRST_VERSION "GLIBC_2.17"
#define PROTOCOL_VERSION FIRST_VERSION
#define JUMP_TO(name) "b " name
#define STAT_VERSION 0
#endif

#define FIRST(name) SINCE(FIRST_VERSION, name)
#define SINCE(version, name)                               \
  __asm__(".symver first_" #name ", " #name "@" version "\n" \
          ".text\n.p2align 4\n"                            \
          ".globl " #name "\n"                             \
          ".hidden " #name "\n"                            \
          ".type " #name ", %function\n" #name ":\n"       \
          "  " JUMP_TO("first_" #name) "\n"                \
          ".size " #name ", . - " #name "\n")

FIRST(exp);
FIRST(exp2);
FIRST(log);
FIRST(pow);
FIRST(hypot);
FIRST(dlopen);
FIRST(dlsym);
FIRST(dlclose);
FIRST(dlerror);
FIRST(pthread_key_create);
FIRST(pthread_key_delete);
FIRST(pthread_getspecific);
FIRST(pthread_setspecific);
FIRST(pthread_once);
FIRST(pthread_create);
FIRST(pthread_join);
FIRST(pthread_detach);
FIRST(pthread_mutexattr_init);
SINCE(PROTOCOL_VERSION, pthread_mutexattr_setprotocol);
FIRST(pthread_mutexattr_destroy);

/* Whether the program has one thread, so that counters need no atomic operation: perhaps not. */
__attribute__((visibility("hidden"))) char __libc_single_threaded = 0;

/* Until 2.33 these were no functions of the library, but inline calls of those below. */
extern int __xstat(int version, const char* path, struct stat* status);
extern int __lxstat(int version, const char* path, struct stat* status);
extern int __fxstat64(int version, int file, struct stat64* status);
__asm__(".symver __xstat, __xstat@" FIRST_VERSION);
__asm__(".symver __lxstat, __lxstat@" FIRST_VERSION);
__asm__(".symver __fxstat64, __fxstat64@" FIRST_VERSION);

__attribute__((visibility("hidden"))) int stat(const char* path, struct stat* status) {
  return __xstat(STAT_VERSION, path, status);
}
__attribute__((visibility("hidden"))) int lstat(const char* path, struct stat* status) {
  return __lxstat(STAT_VERSION, path, status);
}
__attribute__((visibility("hidden"))) int fstat64(int file, struct stat64* status) {
  return __fxstat64(STAT_VERSION, file, status);
}

/* New in 2.36; std::random_device takes it, which nothing here calls. */
__attribute__((visibility("hidden"))) unsigned arc4random(void) {
  unsigned number;
  if (getentropy(&number, sizeof number) != 0) {
    abort();
  }
  return number;
}
