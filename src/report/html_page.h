// A page of HTML that carries everything it shows: no file, no network, and no script but the viewer's.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/legend.h"

namespace rpf::report {

struct Viewer;  // report/viewer.h

/// A picture of a page.
struct Picture {
  std::string file;     ///< PNG or JPEG; its bytes become part of the page
  std::string caption;  ///< also what is read out in place of the picture
  Legend legend = {};   ///< above the caption
};

/// Rows of cells as text. Where the page is narrower, the table scrolls in a box of its own.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::size_t text_columns = 1;  ///< so many from the left hold text, the others numbers
};

/// Grows from top to bottom. All texts are plain: what means something in HTML is escaped. UTF-8 is expected.
class HtmlPage {
 public:
  explicit HtmlPage(const std::string& title);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  /// Text as it stands, in a font of equal widths.
  void code(const std::string& text);
  void table(const Table& table);
  /// Next to each other as far as there is room; `least_width` in CSS pixels is what each gets at least. A picture is
  /// never drawn larger than it is. Throws Error(input) where a file cannot be read or is neither PNG nor JPEG.
  void pictures(const std::vector<Picture>& pictures, int least_width = 260);
  /// A plot of svg_of() in plot.h.
  void plot(const std::string& svg, const std::string& caption);
  /// Pictures to be compared pixel by pixel; a page has one viewer at most.
  void viewer(const Viewer& viewer);
  /// A link to another page beside this one.
  void link(const std::string& target, const std::string& text);

  std::string html() const;
  /// Whole or not at all. Throws Error(output).
  void write(const std::string& path) const;

 private:
  std::string title_, body_, script_;
  int plots_ = 0;
};

}  // namespace rpf::report
