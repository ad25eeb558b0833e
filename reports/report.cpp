#include "validation/result.hpp"
