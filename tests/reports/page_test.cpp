#include "reports/page.hpp"

#include <gtest/gtest.h>

#include <string>

#include "reports/text.hpp"

namespace xpr {
namespace {

const Table awkward{{{"row"}, {"value", true}}, {{{"a|b <x> *y* max_steps _z_"}, {"1.5", Tone::bad}}}};

TEST(MarkdownPage, escapes_what_markdown_reads_as_markup) {
  const auto page = make_markdown_page();
  page->table(awkward);
  EXPECT_EQ(page->finish(), "| row | value |\n| --- | ---: |\n| a\\|b \\<x\\> \\*y\\* max_steps \\_z\\_ | **1.5** |\n");
}

TEST(MarkdownPage, keeps_a_line_end_from_breaking_a_table) {
  const auto page = make_markdown_page();
  page->table({{{"row"}}, {{{"one\ntwo"}}}});
  EXPECT_NE(page->finish().find("| one two |"), std::string::npos);
}

TEST(MarkdownPage, fences_a_listing_that_holds_a_fence) {
  const auto page = make_markdown_page();
  page->listing("```\ncode\n```");
  EXPECT_EQ(page->finish(), "````\n```\ncode\n```\n````\n");
}

TEST(MarkdownPage, links_cells_to_sections) {
  const auto page = make_markdown_page();
  page->table({{{"case"}}, {{{"kerr/shadow", Tone::plain, "case-kerr-shadow"}}}});
  page->begin({4, "kerr/shadow", "case-kerr-shadow", Tone::plain, "3 passed"});
  page->end();
  const std::string text = page->finish();
  EXPECT_NE(text.find("[kerr/shadow](#case-kerr-shadow)"), std::string::npos);
  EXPECT_NE(text.find("<a id=\"case-kerr-shadow\"></a>\n\n#### kerr/shadow (3 passed)"), std::string::npos);
}

TEST(HtmlPage, escapes_text_and_marks_tones) {
  const auto page = make_html_page();
  page->title("a & b");
  page->table(awkward);
  const std::string text = page->finish();
  EXPECT_NE(text.find("<title>a &amp; b</title>"), std::string::npos);
  EXPECT_NE(text.find("<td>a|b &lt;x&gt; *y* max_steps _z_</td><td class=\"number bad\">1.5</td>"), std::string::npos);
}

TEST(HtmlPage, links_its_chapters_below_the_verdict) {
  const auto page = make_html_page();
  page->paragraph("verdict", Tone::good);
  page->begin({2, "Failures", "failures"});
  page->paragraph("inside");
  page->end();
  const std::string text = page->finish();
  EXPECT_LT(text.find("verdict"), text.find("<nav>"));
  EXPECT_LT(text.find("<nav>"), text.find("inside"));
  EXPECT_NE(text.find("<a href=\"#failures\">Failures</a>"), std::string::npos);
}

TEST(HtmlPage, folds_families_and_opens_those_in_trouble) {
  const auto page = make_html_page();
  page->begin({3, "flat", "family-flat", Tone::good, "", true, false});
  page->end();
  page->begin({3, "kerr", "family-kerr", Tone::bad, "", true, true});
  page->end();
  const std::string text = page->finish();
  EXPECT_NE(text.find("<details id=\"family-flat\" class=\"level3\">"), std::string::npos);
  EXPECT_NE(text.find("<details id=\"family-kerr\" class=\"level3\" open>"), std::string::npos);
}

TEST(XmlEscaped, replaces_markup_and_what_xml_does_not_admit) {
  EXPECT_EQ(xml_escaped("<a b=\"c\" & 'd'>"), "&lt;a b=&quot;c&quot; &amp; &apos;d&apos;&gt;");
  EXPECT_EQ(xml_escaped(std::string("x\x01y\0z", 5)), "x\xEF\xBF\xBDy\xEF\xBF\xBDz");
}

TEST(CleanText, keeps_utf8_and_replaces_what_is_not) {
  EXPECT_EQ(clean_text("α\t≤ 1𝄞\n"), "α\t≤ 1𝄞\n");
  EXPECT_EQ(clean_text("caf\xE9!"), "caf\xEF\xBF\xBD!");
  EXPECT_EQ(clean_text("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // overlong
  EXPECT_EQ(clean_text("\xED\xA0\x80").size(), 9U);               // a surrogate, three bytes replaced
  EXPECT_EQ(clean_text("cut \xE2\x89"), "cut \xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(Slug, fits_an_anchor) {
  EXPECT_EQ(slug("kerr/shadow edge (full)"), "kerr-shadow-edge-full");
  EXPECT_EQ(slug("///"), "x");
}

}  // namespace
}  // namespace xpr
