// SPDX-License-Identifier: BSD-3-Clause
// tested-in: cli

#include "flyball/records/version.h"

#include "flyball/runtime/recorder.h"

#include <cstddef>
#include <string_view>

#include <elf.h>
#include <link.h>

namespace flyball {
namespace {

constexpr std::size_t padded(std::size_t size) {
  return (size + 3U) & ~std::size_t{3U};
}

/// Adds the GNU build ids of one segment of ELF notes.
void add_notes(const char* at, std::size_t size, TraceHash& hash) {
  while (size >= sizeof(ElfW(Nhdr))) {
    const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(at);  // The loader's own layout.
    const std::size_t whole = sizeof *note + padded(note->n_namesz) + padded(note->n_descsz);
    if (whole > size) {
      return;
    }
    const char* name = at + sizeof *note;
    if (note->n_type == NT_GNU_BUILD_ID &&
        std::string_view{name, note->n_namesz} == std::string_view{"GNU\0", 4}) {
      hash.add(std::string_view{name + padded(note->n_namesz), note->n_descsz});
    }
    at += whole;
    size -= whole;
  }
}

int add_object(dl_phdr_info* object, std::size_t, void* hash) {
  // The kernel's own page changes with the kernel, not with the build.
  if (std::string_view{object->dlpi_name}.find("vdso") != std::string_view::npos) {
    return 0;
  }
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[i];
    if (segment.p_type == PT_NOTE) {
      // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader tells addresses as integers
      const auto* notes = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
      add_notes(notes, segment.p_memsz, *static_cast<TraceHash*>(hash));
    }
  }
  return 0;
}

std::string fingerprint_of_loaded() {
  TraceHash hash;
  dl_iterate_phdr(add_object, &hash);
  return hash.hex();
}

// Taken before `main`: libraries that are opened later (some open theirs at first use) depend on
// what the program has done so far, and the fingerprint must not.
const std::string at_start = fingerprint_of_loaded();

}  // namespace

std::string version() {
  return FLYBALL_VERSION;
}

std::string build_fingerprint() {
  return at_start;
}

}  // namespace flyball
