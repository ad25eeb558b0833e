#include "validation/papers/papers.hpp"

namespace xpr {

const std::vector<Paper>& all_papers() {
  using namespace papers;
  static const std::vector<Paper> all = {
      darwin_1959(),           //
      iyer_petters_2007(),     //
      bozza_2002(),            //
      virbhadra_ellis_2000(),  //
  };
  return all;
}

}  // namespace xpr
