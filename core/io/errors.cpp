#include "core/io/errors.hpp"

#include <cerrno>
#include <system_error>

namespace xpr {

void throw_system_error(const std::filesystem::path& path, const std::string& what, int error_number) {
  const std::string line = path.string() + ": " + what + ": " + std::generic_category().message(error_number);
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
      throw FaultError(line);
    default:
      throw InputError(line);
  }
}

}  // namespace xpr
