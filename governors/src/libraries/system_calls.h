// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// System calls by what they reach for, see confinement.h.

#include <array>

#include <sys/syscall.h>

namespace flyball {

/// Harmless with any arguments: the memory, threads, signals and time of the process itself, and
/// descriptors that it has.
inline constexpr std::array allowed{
    __NR_brk,   __NR_times,  __NR_getcpu,     __NR_mprotect,    __NR_rt_sigreturn,
    __NR_dup,   __NR_uname,  __NR_sendto,     __NR_recvfrom,    __NR_clock_getres,
    __NR_read,  __NR_ppoll,  __NR_pread64,    __NR_nanosleep,   __NR_gettimeofday,
    __NR_exit,  __NR_writev, __NR_madvise,    __NR_getrusage,   __NR_clock_gettime,
    __NR_write, __NR_munmap, __NR_getppid,    __NR_getrandom,   __NR_rt_sigprocmask,
    __NR_readv, __NR_mremap, __NR_geteuid,    __NR_exit_group,  __NR_set_robust_list,
    __NR_close, __NR_getpid, __NR_getegid,    __NR_membarrier,  __NR_set_tid_address,
    __NR_fstat, __NR_gettid, __NR_sysinfo,    __NR_newfstatat,  __NR_restart_syscall,
    __NR_lseek, __NR_getuid, __NR_seccomp,    __NR_sigaltstack, __NR_clock_nanosleep,
    __NR_futex, __NR_getgid, __NR_pwrite64,   __NR_sched_yield, __NR_sched_getaffinity,
#ifdef __NR_rseq
    __NR_rseq,
#endif
#ifdef __x86_64__
    __NR_poll,  __NR_time,   __NR_arch_prctl, __NR_getrlimit,
#endif
};

/// Questions about files by name: until the policy has started.
inline constexpr std::array looks_at_files{
    __NR_statx,      __NR_faccessat, __NR_readlinkat, __NR_getdents64,
    __NR_getcwd,     __NR_statfs,    __NR_fstatfs,
#ifdef __NR_faccessat2
    __NR_faccessat2,
#endif
#ifdef __x86_64__
    __NR_stat,       __NR_lstat,     __NR_access,     __NR_readlink,
#endif
};

inline constexpr std::array reaches_for_network{
    __NR_socket,  __NR_socketpair, __NR_connect,  __NR_bind,    __NR_listen,   __NR_accept,
    __NR_accept4, __NR_sendmsg,    __NR_sendmmsg, __NR_recvmsg, __NR_shutdown, __NR_setsockopt};

inline constexpr std::array reaches_for_process{
    __NR_kill,  __NR_fcntl,  __NR_ptrace,    __NR_prlimit64,    __NR_rt_sigqueueinfo,
    __NR_clone, __NR_execve, __NR_setpgid,   __NR_setpriority,  __NR_process_vm_readv,
    __NR_tkill, __NR_tgkill, __NR_execveat,  __NR_rt_sigaction, __NR_process_vm_writev,
    __NR_prctl, __NR_setsid,
#ifdef __x86_64__
    __NR_fork,  __NR_vfork,  __NR_setrlimit,
#endif
};

inline constexpr std::array reaches_for_memory{__NR_mmap,         __NR_shmget, __NR_shmat,
                                               __NR_memfd_create, __NR_mlock,  __NR_mlockall,
                                               __NR_msgget,       __NR_semget};

/// All that is left and takes a path or makes a file is `other` only where nobody would ask.
inline constexpr std::array reaches_for_file{
    __NR_openat,   __NR_unlinkat,  __NR_mkdirat,  __NR_linkat,    __NR_symlinkat, __NR_fchmodat,
    __NR_fchownat, __NR_mknodat,   __NR_truncate, __NR_ftruncate, __NR_fallocate, __NR_chdir,
    __NR_mount,    __NR_renameat2,
#ifdef __NR_openat2
    __NR_openat2,
#endif
#ifdef __x86_64__
    __NR_open,     __NR_creat,     __NR_unlink,   __NR_rename,    __NR_renameat,  __NR_mkdir,
    __NR_rmdir,    __NR_link,      __NR_symlink,  __NR_chmod,     __NR_chown,     __NR_mknod,
#endif
};

}  // namespace flyball
