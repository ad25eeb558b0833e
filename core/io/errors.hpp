// The ways in which work ends early, as the command's exit codes tell them apart.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace xpr {

/// What the user gave does not do: bad input, a path that cannot be read or created. One line; exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The machine failed while running: a full disk, a device error. One line; exit code 3.
struct FaultError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The user asked to stop (Ctrl-C). Exit code 130.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws for a system call that failed with `error_number` while doing `what` to `path`: FaultError where the disk is
/// full, over quota or broken, InputError otherwise (no such directory, permission denied).
[[noreturn]] void throw_system_error(const std::filesystem::path& path, const std::string& what, int error_number);

}  // namespace xpr
