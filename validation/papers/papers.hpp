// The papers: one function each, defined in the file of that name, put together in registry.cpp.
#pragma once

#include "validation/paper.hpp"

namespace xpr::papers {

[[nodiscard]] Paper darwin_1959();
[[nodiscard]] Paper iyer_petters_2007();
[[nodiscard]] Paper bozza_2002();
[[nodiscard]] Paper virbhadra_ellis_2000();

}  // namespace xpr::papers
