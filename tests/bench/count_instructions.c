/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A plug-in of qemu's user mode that counts executed instructions of the program and prints their
 * number when it ends. Debian's qemu-user takes plug-ins, but no package has their header, so what is
 * needed of version 1 of that interface stands here (qemu's include/qemu/qemu-plugin.h). */
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef uint64_t plugin_id;
struct qemu_plugin_tb; /* Instructions that are translated together. */
enum { add_to_counter = 0 };

size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* block);
void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id id,
                                           void (*call)(plugin_id, struct qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* block,
                                              int operation,
                                              void* counter,
                                              uint64_t number);
void qemu_plugin_register_atexit_cb(plugin_id id, void (*call)(plugin_id, void*), void* with);

#define SHOWN __attribute__((visibility("default")))

SHOWN int qemu_plugin_version = 1;

static uint64_t executed;

static void on_translation(plugin_id id, struct qemu_plugin_tb* block) {
  (void)id;
  qemu_plugin_register_vcpu_tb_exec_inline(block, add_to_counter, &executed,
                                           qemu_plugin_tb_n_insns(block));
}

static void on_exit(plugin_id id, void* with) {
  (void)id;
  (void)with;
  fprintf(stderr, "instructions %" PRIu64 "\n", executed);
}

SHOWN int qemu_plugin_install(plugin_id id, const void* about, int count, char** options) {
  (void)about;
  (void)count;
  (void)options;
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
  qemu_plugin_register_atexit_cb(id, on_exit, NULL);
  return 0;
}
