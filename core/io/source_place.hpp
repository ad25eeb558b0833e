// Where a part of the input stands at whoever gave it, a file or a program: so that an error can say so.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace xpr {

struct SourcePlace {
  std::string source;                                ///< a file's path, or what a program calls itself
  std::string section;                               ///< "[camera]", "[[instance]] /room/wall"
  int line = 0;                                      ///< of the section; 0 where the source has no lines
  std::map<std::string, int, std::less<>> key_line;  ///< of its keys

  /// Throws InputError: "scenes/a.toml: line 12: [camera] fov is 0 rad, ...": the place and what is wrong there. The
  /// line is that of `key`, or the section's where the key was not given.
  [[noreturn]] void fail(std::string_view key, std::string_view what) const;
  /// The same without a key: "scenes/a.toml: line 10: [camera]: ...".
  [[noreturn]] void fail(std::string_view what) const;
};

}  // namespace xpr
