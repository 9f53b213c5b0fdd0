// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the process of a policy may ask the system for, enforced by the kernel (seccomp(2)).

#include <csignal>
#include <optional>
#include <string>

namespace flyball {

enum class Confinement {
  loading,   ///< Reads files, has threads and memory of its own; nothing else outside of itself.
  deciding,  ///< Opens no file any more.
};

enum class Confined { yes, no_seccomp, failed };

/// Tells a policy's process that its parent may have ended. A policy cannot handle it otherwise.
inline constexpr int parent_ended_signal = SIGUSR2;

/// Confines this process, all its threads, and whatever they become. A forbidden request ends the
/// process; what was confined stays so. Takes effect after `no_new_privs` is set. The parent
/// process is not touched.
[[nodiscard]] Confined confine(Confinement how) noexcept;

/// What a process was ended for, as the end of a sentence, by its exit code.
[[nodiscard]] std::optional<std::string> forbidden_request(int exit_code);

/// The same where the code says nothing.
[[nodiscard]] std::string any_forbidden_request();

}  // namespace flyball
