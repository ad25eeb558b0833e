#include "metrics/fields/field_medium.hpp"

#include <utility>

#include "metrics/spacetime_of.hpp"

namespace xpr {

std::unique_ptr<Spacetime> make_field_spacetime(std::shared_ptr<const FieldModel> model) {
  if (model->centre() != nullptr) {
    CentralFieldMedium medium;
    medium.fields = std::move(model);
    return std::make_unique<SpacetimeOf<CentralFieldMedium>>(std::move(medium));
  }
  FieldMedium medium;
  medium.fields = std::move(model);
  return std::make_unique<SpacetimeOf<FieldMedium>>(std::move(medium));
}

std::unique_ptr<Spacetime> make_field_spacetime(const FieldSet& set) {
  return make_field_spacetime(std::make_shared<const FieldModel>(set));
}

}  // namespace xpr
