#include <fmt/core.h>

#include <cctype>
#include <string_view>

#include "reports/page.hpp"

namespace xpr {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Characters that Markdown reads as markup get a backslash; an underscore inside a word is none (max_steps).
std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool inside_word = i > 0 && i + 1 < text.size() && is_word(text[i - 1]) && is_word(text[i + 1]);
    if (c == '\n' || c == '\r' || c == '\t') {
      out += ' ';
      continue;
    }
    if (std::string_view("\\`*|<>[]~&#$").find(c) != std::string_view::npos || (c == '_' && !inside_word)) out += '\\';
    out += c;
  }
  return out;
}

std::string toned(const std::string& text, Tone tone) {
  return tone == Tone::bad || tone == Tone::warning ? "**" + text + "**" : text;
}

class MarkdownPage : public Page {
 public:
  void title(const std::string& text) override { out_ += "# " + escaped(text) + "\n\n"; }

  void paragraph(const std::string& text, Tone tone) override { out_ += toned(escaped(text), tone) + "\n\n"; }

  void facts(const Facts& facts) override {
    for (const auto& [name, text] : facts) out_ += fmt::format("- {}: {}\n", escaped(name), escaped(text));
    out_ += '\n';
  }

  void table(const Table& table) override {
    std::string rule = "|";
    out_ += '|';
    for (const TableColumn& column : table.columns) {
      out_ += ' ' + escaped(column.title) + " |";
      rule += column.number ? " ---: |" : " --- |";
    }
    out_ += '\n' + rule + '\n';
    for (const std::vector<Cell>& row : table.rows) {
      out_ += '|';
      for (const Cell& cell : row) {
        const std::string text = toned(escaped(cell.text), cell.text.empty() ? Tone::plain : cell.tone);
        const std::string target = cell.file + (cell.anchor.empty() ? "" : "#" + cell.anchor);
        out_ += target.empty() ? fmt::format(" {} |", text) : fmt::format(" [{}]({}) |", text, target);
      }
      out_ += '\n';
    }
    out_ += '\n';
  }

  void listing(const std::string& text) override {
    // A fence longer than any run of backticks inside it.
    std::string fence = "```";
    while (text.find(fence) != std::string::npos) fence += '`';
    out_ += fence + '\n' + text + (text.ends_with('\n') ? "" : "\n") + fence + "\n\n";
  }

  void picture(const Picture& picture) override {
    out_ += fmt::format("![{}]({}.png)\n\n*{}*\n\n", escaped(picture.title), picture.file, escaped(picture.caption));
  }

  void begin(const Section& section) override {
    out_ += fmt::format("<a id=\"{}\"></a>\n\n", section.anchor);
    out_ += fmt::format("{} {}", std::string(static_cast<std::size_t>(section.level), '#'), escaped(section.title));
    if (!section.aside.empty()) out_ += " (" + escaped(section.aside) + ")";
    out_ += "\n\n";
  }

  void end() override {}

  std::string finish() override {
    while (out_.ends_with("\n\n")) out_.pop_back();
    return std::move(out_);
  }

 private:
  std::string out_;
};

}  // namespace

std::unique_ptr<Page> make_markdown_page() { return std::make_unique<MarkdownPage>(); }

}  // namespace xpr
