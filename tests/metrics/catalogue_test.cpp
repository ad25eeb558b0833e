#include "metrics/catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include "metrics/modules.hpp"

namespace xpr {
namespace {

/// What make_spacetime says when it refuses; empty if it does not.
std::string refusal(std::string_view metric, std::string_view chart, const std::vector<NamedValue>& values = {}) {
  try {
    (void)make_spacetime(metric, chart, values);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Catalogue, lists_every_module_once_in_the_order_of_the_type_list) {
  std::vector<const Card*> expected;
  for_each_module([&]<class M>(std::type_identity<M>) { expected.push_back(&M::card); });
  std::vector<const Card*> listed;
  for (const CatalogueEntry& entry : catalogue()) listed.push_back(entry.card);
  EXPECT_EQ(listed, expected);
  std::set<std::pair<std::string_view, std::string_view>> ids;
  for (const Card* card : listed) EXPECT_TRUE(ids.insert({card->metric, card->chart}).second) << card->chart;
}

TEST(Catalogue, makes_each_chart_with_its_defaults_and_with_values) {
  for (const CatalogueEntry& entry : catalogue()) {
    const auto spacetime = make_spacetime(entry.card->metric, entry.card->chart);
    EXPECT_EQ(&spacetime->card(), entry.card);
    const std::vector<NamedValue> values = spacetime->parameters();
    ASSERT_EQ(values.size(), entry.parameters.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(values[i].name, entry.parameters[i].name);
      EXPECT_EQ(values[i].value, entry.parameters[i].fallback);
    }
  }
  const std::vector<NamedValue> set = make_spacetime("kerr", "", std::vector<NamedValue>{{"a", -0.3}})->parameters();
  EXPECT_EQ(set[0].value, 1.0);
  EXPECT_EQ(set[1].value, -0.3);
}

TEST(Catalogue, takes_the_first_chart_of_a_metric_where_none_is_named) {
  EXPECT_EQ(make_spacetime("kerr", "")->card().chart, "kerr-schild");
  EXPECT_EQ(make_spacetime("minkowski", "")->card().chart, "cartesian");
  EXPECT_EQ(make_spacetime("ellis", "")->card().chart, "isotropic");
}

TEST(Catalogue, transports_in_the_chart_that_is_regular_where_light_goes) {
  EXPECT_EQ(transport_chart("kerr", true), "kerr-schild");
  EXPECT_EQ(transport_chart("kerr", false), "kerr-schild-outgoing");
  EXPECT_EQ(transport_chart("schwarzschild", true), "kerr-schild");
  EXPECT_EQ(transport_chart("schwarzschild", false), "kerr-schild-outgoing");
  EXPECT_EQ(transport_chart("ellis", false), "isotropic");
  EXPECT_EQ(transport_chart("minkowski", true), "cartesian");
  EXPECT_EQ(transport_chart("luneburg", true), "cartesian");
  EXPECT_EQ(transport_chart("ellipsoid", false), "geographic");
  EXPECT_THROW((void)transport_chart("keer", true), std::invalid_argument);
}

TEST(Catalogue, offers_the_nearest_name_for_a_typo) {
  EXPECT_EQ(refusal("ker", ""), "unknown metric 'ker': did you mean 'kerr'?");
  EXPECT_EQ(refusal("schwartzschild", ""), "unknown metric 'schwartzschild': did you mean 'schwarzschild'?");
  EXPECT_EQ(refusal("kerr", "boyer-lindqiust"),
            "unknown chart of 'kerr' 'boyer-lindqiust': did you mean 'boyer-lindquist'?");
  EXPECT_EQ(refusal("kerr", "areal"),
            "unknown chart of 'kerr' 'areal'; there is kerr-schild, kerr-schild-outgoing, boyer-lindquist");
  EXPECT_EQ(refusal("kerr", "", {{"mass", 1.0}}), "unknown parameter 'mass' of metric 'kerr'; it has M, a");
  EXPECT_EQ(refusal("ellipsoid", "", {{"a_axs", 1.0}}),
            "unknown parameter 'a_axs' of metric 'ellipsoid': did you mean 'a_axis'?; it has a_axis, f");
  EXPECT_EQ(refusal("minkowski", "", {{"M", 1.0}}), "unknown parameter 'M' of metric 'minkowski'; it has none");
  EXPECT_NE(refusal("banana", "").find("there is minkowski, schwarzschild, kerr"), std::string::npos);
}

TEST(Catalogue, says_which_value_is_out_of_range_and_what_is_allowed) {
  EXPECT_EQ(refusal("kerr", "", {{"a", 1.2}}), "spin a = 1.2, needs |a| <= M = 1");
  EXPECT_EQ(refusal("kerr", "boyer-lindquist", {{"a", -1.2}}), "spin a = -1.2, needs |a| <= M = 1");
  EXPECT_EQ(refusal("schwarzschild", "", {{"M", 0.0}}), "mass M = 0, needs 0 < M < infinity");
  EXPECT_EQ(refusal("ellis", "", {{"b0", -1.0}}), "throat radius b0 = -1, needs 0 < b0 < infinity");
  EXPECT_EQ(refusal("ellipsoid", "", {{"f", 1.0}}), "flattening f = 1, needs f < 1");
  EXPECT_NE(refusal("kerr", "", {{"M", std::numeric_limits<double>::quiet_NaN()}}), "");
  EXPECT_NE(refusal("kerr", "", {{"a", std::numeric_limits<double>::quiet_NaN()}}), "");
  EXPECT_NE(refusal("luneburg", "", {{"R", std::numeric_limits<double>::infinity()}}), "");
  EXPECT_NE(refusal("medium-uniform", "", {{"n", 0.0}}), "");
  EXPECT_EQ(refusal("kerr", "", {{"a", 1.0}}), "") << "the extremal hole is admitted";
  EXPECT_EQ(refusal("kerr", "", {{"a", -1.0}}), "");
}

TEST(NearestName, counts_a_swap_of_neighbours_as_one_and_says_nothing_for_strangers) {
  const std::vector<std::string_view> known = {"kerr", "ellis", "luneburg"};
  EXPECT_EQ(nearest_name("ekrr", known), "kerr");
  EXPECT_EQ(nearest_name("elis", known), "ellis");
  EXPECT_EQ(nearest_name("lunebergg", known), "luneburg");
  EXPECT_EQ(nearest_name("xyzzy", known), "");
  EXPECT_EQ(nearest_name("k", known), "");
  EXPECT_EQ(nearest_name("", known), "");
}

}  // namespace
}  // namespace xpr
