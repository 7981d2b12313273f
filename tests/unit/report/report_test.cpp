// Pages and plots: text is text, nothing is fetched, a plot has what it was given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <regex>

#include "deep_files.h"
#include "report/html_page.h"
#include "report/html_text.h"
#include "report/plot.h"
#include "report/text_file.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "temporary_folder.h"

namespace rpf::report {
namespace {

using testing::HasSubstr;
using testing::Not;

template <class Body>
void expect_error(ErrorKind kind, const std::string& word, const Body& body) {
  deep_files::expect_error(deep_files::error_of(body), kind, {word});
}

std::ptrdiff_t count_of(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  return std::distance(std::sregex_iterator(text.begin(), text.end(), regex), {});
}

Plot two_points() { return {"x", "y", {{"curve", {{1, 2}, {3, 4}}}}, false, false, false, {}}; }

TEST(ReportPage, Base64IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFB\xFF\xFE"), "+//+");
}

TEST(ReportPage, TextStaysText) {
  HtmlPage page("a < b & \"c\"");
  page.heading("<script>");
  page.paragraph("<b>");
  page.code("<i>");
  page.table({{"<u>"}, {{"it's <s>"}}});
  page.link("x\" onclick=\"y", "<a>");
  const std::string html = page.html();
  EXPECT_THAT(html, HasSubstr("<title>a &lt; b &amp; &quot;c&quot;</title>"));
  EXPECT_THAT(html, HasSubstr("it&#39;s &lt;s&gt;"));
  for (const char* tag : {"<script", "<b>", "<i>", "<u>", "<s>", "<a>", "\" onclick"})
    EXPECT_THAT(html, Not(HasSubstr(tag)));
}

TEST(ReportPage, ColumnsOfTextComeFirst) {
  HtmlPage page("t");
  page.table({{"a", "b", "c"}, {{"1", "2", "3"}}, 2});
  EXPECT_THAT(page.html(), HasSubstr(R"(<td class="text">1</td><td class="text">2</td><td>3</td>)"));
}

TEST(ReportPage, PicturesArePartOfIt) {
  const TemporaryFolder folder;
  const std::string file = folder.file("ü <1>.png");
  write_image(file, {{0, 0, 2, 1}, {0, 0, 2, 1}, {"R", "G", "B"}, {0, 0, 0, 1, 1, 1}, {}});
  HtmlPage page("t");
  page.pictures({{file, "a <caption>"}});
  EXPECT_THAT(page.html(), HasSubstr("src=\"data:image/png;base64," + base64(file_bytes(file)) + "\""));
  EXPECT_THAT(page.html(), HasSubstr("alt=\"a &lt;caption&gt;\""));
  EXPECT_THAT(page.html(), Not(HasSubstr(folder.path())));
}

TEST(ReportPage, RefusesWhatIsNoPicture) {
  const TemporaryFolder folder;
  write_bytes(folder.file("text.png"), "text");
  HtmlPage page("t");
  expect_error(ErrorKind::input, "missing.png", [&] { page.pictures({{folder.file("missing.png"), ""}}); });
  expect_error(ErrorKind::input, "text.png", [&] { page.pictures({{folder.file("text.png"), ""}}); });
}

TEST(ReportPage, IsWrittenWholeOrNotAtAll) {
  const TemporaryFolder folder;
  HtmlPage page("t");
  page.write(folder.file("page.html"));
  EXPECT_EQ(file_bytes(folder.file("page.html")), page.html());
  EXPECT_EQ(folder.entry_count(), 1U);
  expect_error(ErrorKind::output, "no-folder", [&] { page.write(folder.file("no-folder/page.html")); });
  expect_error(ErrorKind::output, "/dev/full", [&] { write_text("/dev/full", "x"); });
}

TEST(ReportPage, FetchesNothingAndRunsNothing) {
  HtmlPage page("t");
  page.plot(svg_of(two_points()), "c");
  page.plot(svg_of(two_points()), "c");
  const std::string html = page.html();
  for (const char* word : {"http", "file:", "<script", "@import", "url(", "xlink", "<?xml", "Gnuplot<"})
    EXPECT_THAT(html, Not(HasSubstr(word)));
  EXPECT_EQ(count_of(html, R"(id='plot1-gpPt7')"), 1) << "two plots, each with names of its own";
  EXPECT_EQ(count_of(html, R"(id='plot2-gpPt7')"), 1);
  EXPECT_THAT(html, HasSubstr("href='#plot2-gpPt"));
  EXPECT_THAT(html, Not(HasSubstr("href='#gpPt")));
}

TEST(ReportPlot, HasLabelsAndEveryPoint) {
  Plot plot = two_points();
  plot.x_label = "it's x_1 {a} \\n \"b\"";
  plot.y_label = "ü < &\nsecond";
  plot.curves[0].name = "c^2 $x";
  const std::string svg = svg_of(plot);
  EXPECT_THAT(svg, HasSubstr("it's x_1 {a} \\n \"b\""));
  EXPECT_THAT(svg, HasSubstr("ü &lt; &amp; second"));
  EXPECT_THAT(svg, HasSubstr("c^2 $x"));
  EXPECT_EQ(count_of(svg, "<use xlink:href='#gpPt6'"), 3) << "two points and one in the legend";
}

TEST(ReportPlot, LeavesOutWhatHasNoPlace) {
  Plot plot = two_points();
  plot.log_y = true;
  plot.curves[0].points = {{1, 2}, {2, NAN}, {3, INFINITY}, {4, 0}, {5, -1}, {6, 3}};
  EXPECT_EQ(count_of(svg_of(plot), "<use xlink:href='#gpPt6'"), 3);
}

TEST(ReportPlot, WithoutAPointIsEmpty) {
  Plot plot = two_points();
  plot.log_x = plot.log_y = true;
  plot.curves[0].points = {{0, 0}};
  EXPECT_THAT(svg_of(plot), HasSubstr("</svg>"));
  plot.curves.clear();
  EXPECT_THAT(svg_of(plot), HasSubstr("</svg>"));
}

TEST(ReportPlot, OfOneValueHasARangeAndNothingToSay) {
  for (const double value : {0.0, 1.0, 1e9})
    for (const bool bars : {false, true}) {
      Plot plot = two_points();
      plot.bars = bars;
      plot.curves[0].points = {{value, value}};
      ::testing::internal::CaptureStderr();
      EXPECT_THAT(svg_of(plot), HasSubstr("</svg>"));
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << value << bars;
    }
}

TEST(ReportPlot, DrawsBarsAndTicks) {
  Plot plot = two_points();
  plot.bars = true;
  plot.curves[0].points = {{1.25, 70}, {2.75, 300}};
  plot.x_ticks = {1.25, 2.75};
  const std::string svg = svg_of(plot);
  EXPECT_EQ(count_of(svg, "<polygon"), 3) << "two bars and one in the legend";
  EXPECT_EQ(count_of(svg, ">\\s*(1.25|2.75)</text>"), 2);
  EXPECT_EQ(count_of(svg, ">\\s*(0.5|1.5|2.5)</text>"), 0) << "what gnuplot would choose";
}

TEST(ReportPlot, SaysWhatToInstall) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  expect_error(ErrorKind::output, "apt-get install gnuplot-nox", [] { check_plotting(); });
  setenv("PATH", path.c_str(), 1);
  EXPECT_NO_THROW(check_plotting());
}

}  // namespace
}  // namespace rpf::report
