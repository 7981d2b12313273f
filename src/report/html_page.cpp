#include "report/html_page.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string_view>

#include "report/html_text.h"
#include "report/page_files.h"
#include "report/text_file.h"
#include "report/viewer.h"
#include "rpf/error.h"

namespace rpf::report {
namespace {

std::string element(const char* name, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>\n", name, escaped(text));
}

std::string row(const char* cell, const std::vector<std::string>& texts, std::size_t text_columns) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < texts.size(); ++i)
    html += fmt::format("<{0}{1}>{2}</{0}>", cell, i < text_columns ? " class=\"text\"" : "", escaped(texts[i]));
  return html + "</tr>\n";
}

bool starts_with(const std::string& bytes, std::string_view magic) {
  return bytes.compare(0, magic.size(), magic) == 0;
}

/// The file as an address that contains it.
std::string data_address(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const bool png = starts_with(bytes, "\x89PNG"), jpeg = starts_with(bytes, "\xFF\xD8\xFF");
  if (!png && !jpeg)
    throw Error(ErrorKind::input, fmt::format("\"{}\" cannot be shown in a page; a PNG or JPEG is expected", file));
  return fmt::format("data:image/{};base64,{}", png ? "png" : "jpeg", base64(bytes));
}

/// An SVG file as a part of a page: names get a prefix, since a page may have several plots.
std::string as_part(const std::string& svg, const std::string& prefix) {
  const auto begin = svg.find("<svg");
  std::string part = begin == std::string::npos ? svg : svg.substr(begin);
  part = std::regex_replace(part, std::regex(R"(<(title|desc)>[^<]*</\1>)"), "");
  part = std::regex_replace(part, std::regex(R"(\sxmlns(:\w+)?="[^"]*")"), "");
  part = std::regex_replace(part, std::regex(R"(\bid=(["']))"), "id=$1" + prefix);
  return std::regex_replace(part, std::regex(R"(xlink:href=(["'])#)"), "href=$1#" + prefix);
}

}  // namespace

HtmlPage::HtmlPage(const std::string& title) : title_(title) {}

void HtmlPage::heading(const std::string& text) { body_ += element("h2", text); }
void HtmlPage::paragraph(const std::string& text) { body_ += element("p", text); }
void HtmlPage::code(const std::string& text) { body_ += element("pre", text); }

void HtmlPage::table(const Table& table) {
  body_ += "<div class=\"wide\"><table>\n" + row("th", table.header, table.text_columns);
  for (const auto& cells : table.rows) body_ += row("td", cells, table.text_columns);
  body_ += "</table></div>\n";
}

void HtmlPage::pictures(const std::vector<Picture>& pictures, int least_width) {
  body_ += fmt::format("<div class=\"grid\" style=\"--least: {}px\">\n", least_width);
  for (const Picture& picture : pictures)
    body_ += fmt::format("<figure><img src=\"{}\" alt=\"{}\">{}<figcaption>{}</figcaption></figure>\n",
                         data_address(picture.file), escaped(picture.caption), legend_html(picture.legend),
                         escaped(picture.caption));
  body_ += "</div>\n";
}

void HtmlPage::plot(const std::string& svg, const std::string& caption) {
  body_ += fmt::format("<figure class=\"plot\"><div class=\"wide\">{}</div><figcaption>{}</figcaption></figure>\n",
                       as_part(svg, fmt::format("plot{}-", ++plots_)), escaped(caption));
}

void HtmlPage::viewer(const Viewer& viewer) {
  body_ += viewer_html(viewer);
  script_ = page_files().at("viewer.js");
}

void HtmlPage::link(const std::string& target, const std::string& text) {
  body_ += fmt::format("<p><a href=\"{}\">{}</a></p>\n", escaped(target), escaped(text));
}

std::string HtmlPage::html() const {
  const std::string script = script_.empty() ? "" : "<script>\n" + script_ + "</script>\n";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>\n{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}{3}</body>\n</html>\n",
      escaped(title_), page_files().at("page.css"), body_, script);
}

void HtmlPage::write(const std::string& path) const { write_text(path, html()); }

}  // namespace rpf::report
