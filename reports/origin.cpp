#include "reports/origin.hpp"

namespace xpr {

Facts provenance_facts(const Provenance& from) {
  return {{"version", from.version},
          {"commit", from.commit + (from.dirty ? " with changes that are not committed" : "")},
          {"compiler", from.compiler},
          {"build_type", from.build_type},
          {"hdf5", from.hdf5}};
}

Facts volatile_facts(const Provenance& from) {
  return {{"date", from.date}, {"cpu", from.cpu}, {"isa", from.isa}, {"flags", from.flags}};
}

std::string configuration_text(const Json& configuration) {
  return configuration.dump(2, ' ', false, Json::error_handler_t::replace);
}

void write_origin(Hdf5File& file, const Origin& origin) {
  file.make_group("/provenance");
  for (const auto& [name, text] : provenance_facts(origin.provenance)) file.set_attribute("/provenance", name, text);
  file.set_attribute("/provenance", "configuration", configuration_text(origin.configuration));
  file.set_attribute("/provenance", "command", origin.command);
  for (const auto& [name, digits] : origin.hashes) file.set_attribute("/provenance", name, digits);
  file.make_group("/volatile");
  for (const auto& [name, text] : volatile_facts(origin.provenance)) file.set_attribute("/volatile", name, text);
}

}  // namespace xpr
