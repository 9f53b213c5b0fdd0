/* SPDX-License-Identifier: BSD-3-Clause */
/* A hostile policy in plain C. What it does, and when, is the name of its file: `decide-fork.so`
 * forks when it is asked. So one file makes many libraries: each is a copy. */

#define _GNU_SOURCE

#include "flyball/governors/plugin_abi.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

/* What the host receives; hostile_libraries_test.cpp compares them with its packets. */
enum { answer_size = 1432, opening_size = 536 };

static const FlyballHost* host;
static volatile int sink;

/* In the order of what they reach for. */
static void do_fork(void) {
  if (fork() == 0) {
    for (;;)
      pause();
  }
}
static void do_vfork(void) {
  if (vfork() == 0)
    _exit(0);
}
static void do_clone(void) {
  syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
}
static void do_system(void) {
  sink = system("true");
}
static void do_exec(void) {
  execl("/bin/true", "true", NULL);
}
static void do_kill(void) {
  kill(getppid(), SIGTERM);
}
static void do_killall(void) {
  kill(-1, 0);
}
static void do_setsid(void) {
  setsid();
}
static void do_setpgid(void) {
  setpgid(0, getppid());
}
static void do_ptrace(void) {
  ptrace(PTRACE_ATTACH, getppid(), 0, 0);
}
static void do_readmem(void) {
  char byte;
  struct iovec here = {&byte, 1}, there = {(void*)&sink, 1};
  process_vm_readv(getppid(), &here, 1, &there, 1, 0);
}
static void do_outlive(void) {
  prctl(PR_SET_PDEATHSIG, 0);
}
static void do_handler(void) {
  signal(SIGSYS, SIG_IGN);
}
static void do_orphan(void) {
  signal(SIGUSR2, SIG_IGN); /* By which it hears that its parent has ended. */
}
static void do_sigio(void) {
  fcntl(3, F_SETOWN, getppid());
}
static void* fork_there(void* nothing) {
  do_fork();
  return nothing;
}
static void do_threadfork(void) {
  pthread_t thread;
  if (pthread_create(&thread, NULL, fork_there, NULL) == 0)
    pthread_join(thread, NULL);
}
static void do_socket(void) {
  sink = socket(AF_INET, SOCK_STREAM, 0);
}
static void do_udp(void) {
  sink = socket(AF_INET6, SOCK_DGRAM, 0);
}
static void do_unix(void) {
  int two[2];
  sink = socketpair(AF_UNIX, SOCK_STREAM, 0, two);
}
static void do_read(void) {
  sink = open("/etc/passwd", O_RDONLY);
}
static void do_write(void) {
  sink = open("hostile.txt", O_WRONLY | O_CREAT, 0600);
}
static void do_append(void) {
  sink = open("/dev/null", O_RDWR | O_APPEND);
}
static void do_fopen(void) {
  sink = fopen("hostile.txt", "w") != NULL;
}
static void do_unlink(void) {
  unlink("hostile.txt");
}
static void do_rename(void) {
  sink = rename("hostile.txt", "hostile2.txt");
}
static void do_mkdir(void) {
  sink = mkdir("hostile", 0700);
}
static void do_chmod(void) {
  sink = chmod("/tmp", 0700);
}
static void do_shm(void) {
  sink = shmget(IPC_PRIVATE, 1 << 20, IPC_CREAT | 0600);
}
static void do_memfd(void) {
  sink = memfd_create("hostile", 0);
}
static void do_shared(void) {
  sink = mmap(NULL, 1 << 20, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0) != NULL;
}
static void do_memory(void) {
  for (;;) {
    char* block = malloc(1 << 24);
    if (block == NULL)
      abort();
    memset(block, 1, 1 << 24);
  }
}
static void do_mount(void) {
  syscall(SYS_mount, "", "/", "", 0, "");
}
static void do_uring(void) {
  syscall(425, 8, NULL); /* io_uring_setup */
}
static void do_segv(void) {
  raise(SIGSEGV);
}
static void do_abort(void) {
  abort();
}
static void do_exit(void) {
  exit(7);
}
static void do_stop(void) {
  raise(SIGSTOP);
}
static void do_hang(void) {
  for (;;)
    sink = sink + 1;
}
static void do_sleep(void) {
  sleep(1000);
}
static void do_recurse(void) {
  volatile char space[1 << 12];
  space[0] = 1;
  do_recurse();
  sink = space[0];
}
/* The socket to the host is one of these. */
static void send_all(const void* packet, size_t size) {
  for (int i = 3; i < 64; ++i) {
    ssize_t sent = send(i, packet, size, MSG_NOSIGNAL);
    (void)sent;
  }
}
static void do_shortpacket(void) {
  send_all("x", 1);
}
static void do_longpacket(void) {
  static char much[65536];
  send_all(much, sizeof much);
}
static void do_badpacket(void) { /* As long as an answer, without a zero in it. */
  static char much[answer_size];
  memset(much, 'A', sizeof much);
  send_all(much, sizeof much);
}
static void do_zeropacket(void) { /* Texts that end, but of no question. */
  static char much[answer_size];
  send_all(much, sizeof much);
}
static void do_badopening(void) {
  static char much[opening_size];
  memset(much, 'A', sizeof much);
  send_all(much, sizeof much);
}
static void do_closed(void) {
  for (int i = 0; i < 64; ++i)
    close(i);
}

typedef struct Crime {
  const char* name;
  void (*commit)(void);
} Crime;

#define CRIME(name) \
  { #name, do_##name }
static const Crime crimes[] = {
    CRIME(fork),       CRIME(vfork),     CRIME(clone),      CRIME(system),     CRIME(exec),
    CRIME(kill),       CRIME(killall),   CRIME(setsid),     CRIME(setpgid),    CRIME(ptrace),
    CRIME(readmem),    CRIME(outlive),   CRIME(handler),    CRIME(orphan),    CRIME(sigio),      CRIME(threadfork),
    CRIME(socket),     CRIME(udp),       CRIME(unix),       CRIME(read),       CRIME(write),
    CRIME(append),     CRIME(fopen),     CRIME(unlink),     CRIME(rename),     CRIME(mkdir),
    CRIME(chmod),      CRIME(shm),       CRIME(memfd),      CRIME(shared),     CRIME(memory),
    CRIME(mount),      CRIME(uring),     CRIME(segv),       CRIME(abort),      CRIME(exit),
    CRIME(stop),       CRIME(hang),      CRIME(sleep),      CRIME(recurse),    CRIME(shortpacket),
    CRIME(longpacket), CRIME(badpacket), CRIME(zeropacket), CRIME(badopening), CRIME(closed)};

/* "decide-fork" of /tmp/x/decide-fork.so */
static const char* own_name(void) {
  static char name[64];
  Dl_info found;
  if (dladdr((const void*)&crimes, &found) != 0) {
    const char* slash = strrchr(found.dli_fname, '/');
    snprintf(name, sizeof name, "%s", slash == NULL ? found.dli_fname : slash + 1);
    name[strcspn(name, ".")] = '\0';
  }
  return name;
}

static int is(const char* name) {
  return strcmp(own_name(), name) == 0;
}

static void commit_at(const char* moment) {
  const char* name = own_name();
  const size_t length = strlen(moment);
  if (strncmp(name, moment, length) != 0 || name[length] != '-')
    return;
  for (size_t i = 0; i < sizeof crimes / sizeof crimes[0]; ++i) {
    if (strcmp(name + length + 1, crimes[i].name) == 0)
      crimes[i].commit();
  }
}

__attribute__((constructor)) static void load(void) {
  commit_at("load");
}

static void* create(const FlyballHost* given, const FlyballStart* start) {
  host = given;
  if (is("create-silent"))
    return NULL;
  if (is("create-endless")) {
    memset(start->refusal, 'A', start->refusal_size);
    return NULL;
  }
  commit_at("create");
  return (void*)&crimes;
}

static void destroy(void* self) {
  (void)self;
}

static int32_t decide(void* self, const FlyballObservation* seen, FlyballDecision* decision) {
  (void)self;
  (void)seen;
  commit_at("decide");
  if (is("decide-escape")) {
    host->log(host->context, "\033]0;owned\007\033[2J");
    return 1;
  }
  if (is("decide-silent"))
    return 1;
  decision->wish_count = 0;
  return 0;
}

static double period_s(void* self) {
  (void)self;
  return is("period-tiny") ? 1e-5 : is("period-nan") ? NAN : is("period-negative") ? -1.0 : 0.0;
}

static FlyballParameter one = {sizeof(FlyballParameter), 0, "one", "A number.", 0.0, 0.0, 1.0};
static FlyballParameter nameless = {sizeof(FlyballParameter), 0, NULL, NULL, 0.0, 0.0, 1.0};
static const FlyballParameter* parameters[2] = {&one, &one};

static FlyballPolicy policy = {sizeof(FlyballPolicy),
                               flyball_abi_version,
                               "hostile",
                               "Hostile",
                               parameters,
                               1,
                               0,
                               create,
                               destroy,
                               decide,
                               period_s};

const FlyballPolicy* flyball_policy(void) {
  if (is("entry-null"))
    return NULL;
  if (is("entry-small"))
    policy.struct_size = 8;
  if (is("entry-undecided"))
    policy.decide = NULL;
  if (is("entry-nolist"))
    policy.parameters = NULL;
  if (is("entry-many"))
    policy.parameter_count = 1000000;
  if (is("entry-twice"))
    policy.parameter_count = 2;
  if (is("entry-nameless"))
    parameters[0] = &nameless;
  if (is("entry-bounds"))
    one.min = 2.0;
  if (is("entry-nan"))
    one.max = NAN;
  if (is("entry-default"))
    one.fallback = NAN;
  commit_at("entry");
  return &policy;
}
