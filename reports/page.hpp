// The pieces that a report page is made of, said once and laid out twice: as Markdown and as HTML.
// All text is plain; each layout escapes it in its own way.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace xpr {

/// How a cell or a paragraph is to be seen. Words carry the meaning; colour only repeats it.
enum class Tone { plain, good, bad, warning, muted };

struct Cell {
  std::string text;
  Tone tone = Tone::plain;
  std::string anchor = "";  ///< links to the section of that anchor where not empty
  std::string file = "";    ///< links to that file of the report where not empty
};

struct TableColumn {
  std::string title;
  bool number = false;  ///< aligned to the right
};

struct Table {
  std::vector<TableColumn> columns;
  std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
};

/// Lines of the form "name: text".
using Facts = std::vector<std::pair<std::string, std::string>>;

struct Picture {
  std::string file;  ///< path without ending, relative to the report; .svg and .png exist
  std::string title;
  std::string caption;
};

/// A heading and all that follows up to the matching end. Level 2 is a chapter, 3 a family, 4 a case.
struct Section {
  int level = 2;
  std::string title;
  std::string anchor;  ///< unique in the page
  Tone tone = Tone::plain;
  std::string aside = "";  ///< said beside the title, such as its counts
  bool foldable = false;   ///< HTML may fold it
  bool open = true;
};

/// A page in one format, filled from top to bottom.
class Page {
 public:
  virtual ~Page() = default;
  virtual void title(const std::string& text) = 0;
  virtual void paragraph(const std::string& text, Tone tone = Tone::plain) = 0;
  virtual void facts(const Facts& facts) = 0;
  virtual void table(const Table& table) = 0;
  /// Set in a fixed-width face, line ends kept.
  virtual void listing(const std::string& text) = 0;
  virtual void picture(const Picture& picture) = 0;
  virtual void begin(const Section& section) = 0;
  virtual void end() = 0;
  /// The whole page; nothing is added after it.
  [[nodiscard]] virtual std::string finish() = 0;
};

/// GitHub-flavoured Markdown, tables included.
[[nodiscard]] std::unique_ptr<Page> make_markdown_page();

/// One page that needs nothing but its figures: style inline, light and dark, no scripts.
[[nodiscard]] std::unique_ptr<Page> make_html_page();

}  // namespace xpr
