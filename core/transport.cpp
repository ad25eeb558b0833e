#include "core/transport.hpp"
