#include <fmt/core.h>

#include <cstddef>
#include <string_view>

#include "reports/page.hpp"
#include "reports/text.hpp"

namespace xpr {
namespace {

constexpr std::string_view style = R"(
:root { color-scheme: light dark; --ink: #1b1f24; --paper: #ffffff; --soft: #f4f5f7; --line: #d5d9df; --dim: #5b6570;
  --link: #0b5cad; --good: #00664b; --bad: #b3261e; --bad-paper: #fdecea; --warning: #7a5200; --warning-paper: #fff4dc; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7eb; --paper: #14171a; --soft: #1d2126; --line: #363c44;
  --dim: #9aa4af; --link: #7ab7ff; --good: #5fd3ac; --bad: #ff8a80; --bad-paper: #3a1a1a; --warning: #f0c05a;
  --warning-paper: #352a12; } }
* { box-sizing: border-box; }
html { scroll-padding-top: 1rem; }
body { margin: 0 auto; max-width: 78rem; padding: 2rem 1.25rem 6rem; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 1rem; } h2 { font-size: 1.3rem; } h3 { font-size: 1.1rem; } h4 { font-size: 1rem; }
h2, h3, h4 { display: inline; margin: 0; }
section, details { margin: 1.6rem 0; }
section > :first-child, summary { margin-bottom: .7rem; }
section.level2, details.level2 { border-top: 1px solid var(--line); padding-top: 1.4rem; }
details.level3 { border: 1px solid var(--line); border-radius: .5rem; padding: .7rem 1rem; margin: .9rem 0; }
summary { cursor: pointer; }
a { color: var(--link); text-decoration: none; } a:hover { text-decoration: underline; }
.aside { color: var(--dim); margin-left: .6rem; font-size: .93rem; }
nav { display: flex; flex-wrap: wrap; gap: .3rem 1.1rem; margin: 1rem 0 0; font-size: .95rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; margin: .5rem 0 1rem; }
th, td { padding: .28rem .65rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
th { background: var(--soft); font-weight: 600; white-space: nowrap; }
.number { text-align: right; white-space: nowrap; }
.good { color: var(--good); } .muted { color: var(--dim); }
.bad { color: var(--bad); font-weight: 600; } .warning { color: var(--warning); font-weight: 600; }
td.bad { background: var(--bad-paper); } td.warning { background: var(--warning-paper); }
p.good, p.bad, p.warning { font-size: 1.1rem; font-weight: 600; padding: .7rem 1rem; border-radius: .5rem;
  border-left: .35rem solid currentColor; background: var(--soft); }
p.bad { background: var(--bad-paper); } p.warning { background: var(--warning-paper); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .15rem 1rem; font-size: .92rem; }
dt { color: var(--dim); } dd { margin: 0; overflow-wrap: anywhere; }
pre { background: var(--soft); border-radius: .5rem; padding: .8rem 1rem; overflow-x: auto; font-size: .85rem; }
figure { margin: 1.2rem 0 2rem; } figcaption { color: var(--dim); font-size: .92rem; max-width: 60rem; }
figure img { max-width: 100%; height: auto; background: #fff; border-radius: .5rem; padding: .6rem; }
@media print { details > * { display: block; } nav { display: none; } }
)";

std::string_view tone_class(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "good";
    case Tone::bad:
      return "bad";
    case Tone::warning:
      return "warning";
    case Tone::muted:
      return "muted";
    case Tone::plain:
      break;
  }
  return "";
}

std::string class_attribute(std::string_view first, std::string_view second = {}) {
  if (first.empty() && second.empty()) return {};
  return fmt::format(" class=\"{}{}{}\"", first, first.empty() || second.empty() ? "" : " ", second);
}

class HtmlPage : public Page {
 public:
  void title(const std::string& text) override { title_ = xml_escaped(text); }

  void paragraph(const std::string& text, Tone tone) override {
    out() += fmt::format("<p{}>{}</p>\n", class_attribute(tone_class(tone)), xml_escaped(text));
  }

  void facts(const Facts& facts) override {
    out() += "<dl>\n";
    for (const auto& [name, text] : facts) {
      out() += fmt::format("<dt>{}</dt><dd>{}</dd>\n", xml_escaped(name), xml_escaped(text));
    }
    out() += "</dl>\n";
  }

  void table(const Table& table) override {
    out() += "<div class=\"scroll\"><table>\n<thead><tr>";
    for (const TableColumn& column : table.columns) {
      out() += fmt::format("<th{}>{}</th>", class_attribute(column.number ? "number" : ""), xml_escaped(column.title));
    }
    out() += "</tr></thead>\n<tbody>\n";
    for (const std::vector<Cell>& row : table.rows) {
      out() += "<tr>";
      for (std::size_t i = 0; i < row.size(); ++i) {
        const Cell& cell = row[i];
        std::string text = xml_escaped(cell.text);
        const std::string target = xml_escaped(cell.file) + (cell.anchor.empty() ? "" : "#" + cell.anchor);
        if (!target.empty()) text = fmt::format("<a href=\"{}\">{}</a>", target, text);
        const std::string_view alignment = i < table.columns.size() && table.columns[i].number ? "number" : "";
        out() += fmt::format("<td{}>{}</td>", class_attribute(alignment, tone_class(cell.tone)), text);
      }
      out() += "</tr>\n";
    }
    out() += "</tbody>\n</table></div>\n";
  }

  void listing(const std::string& text) override { out() += "<pre>" + xml_escaped(text) + "</pre>\n"; }

  void picture(const Picture& picture) override {
    const std::string file = xml_escaped(picture.file);
    const std::string caption = xml_escaped(picture.caption);
    out() += fmt::format(
        "<figure>\n<a href=\"{0}.svg\"><img src=\"{0}.svg\" alt=\"{1}\" loading=\"lazy\"></a>\n"
        "<figcaption><strong>{2}.</strong> {1}</figcaption>\n</figure>\n",
        file, caption, xml_escaped(picture.title));
  }

  void begin(const Section& section) override {
    if (section.level == 2) {
      links_ += fmt::format("<a href=\"#{}\">{}</a>\n", section.anchor, xml_escaped(section.title));
    }
    chapters_begun_ = true;
    const std::string heading =
        fmt::format("<h{0}{1}>{2}</h{0}>", section.level, class_attribute(tone_class(section.tone)),
                    xml_escaped(section.title)) +
        (section.aside.empty() ? "" : fmt::format("<span class=\"aside\">{}</span>", xml_escaped(section.aside)));
    const std::string level = fmt::format("level{}", section.level);
    if (section.foldable) {
      out() += fmt::format("<details id=\"{}\"{}{}>\n<summary>{}</summary>\n", section.anchor, class_attribute(level),
                           section.open ? " open" : "", heading);
    } else {
      out() += fmt::format("<section id=\"{}\"{}>\n<div>{}</div>\n", section.anchor, class_attribute(level), heading);
    }
    folded_.push_back(section.foldable);
  }

  void end() override {
    out() += folded_.back() ? "</details>\n" : "</section>\n";
    folded_.pop_back();
  }

  std::string finish() override {
    return fmt::format(
               "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
               "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
               "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
               title_, style) +
           top_ + "<nav>\n" + links_ + "</nav>\n" + chapters_ + "</body>\n</html>\n";
  }

 private:
  std::string& out() { return chapters_begun_ ? chapters_ : top_; }

  std::string title_;
  std::string top_;  // the verdict: links to the chapters stand below it
  std::string links_;
  std::string chapters_;
  bool chapters_begun_ = false;
  std::vector<bool> folded_;  // for each open section: whether it is a <details>
};

}  // namespace

std::unique_ptr<Page> make_html_page() { return std::make_unique<HtmlPage>(); }

}  // namespace xpr
