// The report as HTML: verdict, table, figures, settings, and how to judge.
#include "page.hpp"

#include <fstream>
#include <iterator>
#include <string>

#include "base64.hpp"
#include "text_file.hpp"

namespace feeler::demo {
namespace {

constexpr const char* head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<style>
:root { color-scheme: light; }
body { font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif; color: #222; background: #f4f5f6; margin: 0; }
main { max-width: 1000px; margin: 2.5rem auto; padding: 2rem 2.5rem; background: #fff; border: 1px solid #e3e6e9; border-radius: 8px; }
h1 { margin: 0; font-size: 1.7rem; } h2 { margin: 2.2rem 0 .6rem; font-size: 1.1rem; }
.verdict { display: inline-block; margin: 1rem 0 .3rem; padding: .35rem .9rem; border-radius: 999px; font-weight: 600; }
.free { background: #e2f3e8; color: #1d6b3f; } .penetrated { background: #fbe3e1; color: #a3241d; }
table { border-collapse: collapse; width: 100%; } td { padding: .32rem .6rem; border-bottom: 1px solid #eceff1; vertical-align: top; }
td:first-child { color: #5b6670; width: 15rem; } td:last-child { font-variant-numeric: tabular-nums; }
figure { margin: 1.6rem 0; } figure svg, figure img { width: 100%; height: auto; display: block; }
figcaption { color: #5b6670; font-size: .92rem; margin-top: .3rem; }
pre { background: #f4f5f6; padding: 1rem; overflow-x: auto; font-size: .82rem; line-height: 1.4; border-radius: 6px; }
iframe { width: 100%; height: 720px; border: 1px solid #d5dbe1; border-radius: 6px; }
button { font: inherit; padding: .35rem .9rem; border: 1px solid #2f6db5; border-radius: 6px; background: #2f6db5; color: #fff; cursor: pointer; }
code { font-size: .92em; } summary { cursor: pointer; color: #2f6db5; }
</style>
)";

constexpr const char* how_to_judge = R"(<h2>Judge it yourself</h2>
<p>Everything is in metres, newtons and seconds, world axes, 17 digits. For each line of <code>path.csv</code> put <code>tool.off</code> at
the pose, <code>point_world = p + R(q) · point_tool</code> with q = (w, x, y, z), and test it against every triangle of
<code>object.off</code> with a program of your own: its interior must meet none. Do the same between two lines: p moves on a straight line,
and R turns at a constant rate. The last line of a tick is its graphic pose in <code>ticks.csv</code>. A face of two vertices is a segment.
The wrench is K times the pose difference, with K in <code>scene.json</code>: F = K<sub>t</sub> (p<sub>g</sub> − p<sub>h</sub>),
T = K<sub>r</sub> Log(R<sub>g</sub> R<sub>h</sub><sup>T</sup>). <code>tick_us</code> is the time of the renderer's update alone.</p>
)";

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else if (c == '>') result += "&gt;";
    else result += c;
  }
  return result;
}

/// A drawing where it is small, a picture where it is not: a browser takes seconds for a hundred thousand
/// polygons.
std::string figure_html(const std::filesystem::path& folder, const Figure& figure) {
  constexpr std::size_t large = 2000000;
  std::string drawing = content_of(folder / (figure.name + ".svg"));
  if (drawing.empty() || drawing.size() > large) {
    return "<img alt=\"" + figure.name + "\" src=\"data:image/png;base64," + base64(content_of(folder / (figure.name + ".png"))) + "\">";
  }
  const std::size_t start = drawing.find("<svg");
  return start == std::string::npos ? std::string() : drawing.substr(start);
}

std::string as_attribute(const std::string& text) {
  std::string result;
  result.reserve(text.size() + text.size() / 16);
  for (const char c : text) {
    if (c == '&') result += "&amp;";
    else if (c == '"') result += "&quot;";
    else result += c;
  }
  return result;
}

/// The viewer with the run inside, in a frame that is filled when somebody wants it.
std::string player_html(const std::string& player) {
  return R"(<h2>Play it</h2>
<p><button type="button" onclick="const f = document.getElementById('player'); f.srcdoc = f.dataset.page; f.hidden = false; this.hidden = true">Open
the run in this page</button> Drag to look around, and scrub through the time. The same in a window of its own, or two runs side by side:
<code>feeler-demo --replay FOLDER [FOLDER] --view</code>.</p>
<iframe id="player" title="The run" hidden data-page=")" +
         as_attribute(player) + "\"></iframe>\n";
}

}  // namespace

void write_page(const std::filesystem::path& file, const std::filesystem::path& folder, const scenes::Scene& scene, const Summary& summary,
                const std::vector<Figure>& figures, const std::string& player) {
  TextFile text(file);
  text.write(head);
  text.write("<title>Feeler: " + escaped(scene.name) + "</title></head><body><main>\n<h1>" + escaped(scene.name) + "</h1>\n<p>" +
             escaped(scene.description) + " " + std::to_string(scene.triangles.rows()) + " triangles.</p>\n");
  text.write(summary.verification.penetrated() ? "<div class=\"verdict penetrated\">The tool penetrated the object.</div>\n"
                                               : "<div class=\"verdict free\">No penetration found.</div>\n");
  text.write("<table>\n");
  for (const auto& [name, value] : table_of(summary)) {
    text.write("<tr><td>" + escaped(name) + "</td><td>" + escaped(value) + "</td></tr>\n");
  }
  text.write("</table>\n");
  if (!player.empty()) text.write(player_html(player));
  if (figures.empty()) text.write("<p>No figures: gnuplot was not found when this report was written.</p>\n");
  for (const Figure& figure : figures) {
    text.write("<figure>" + figure_html(folder, figure) + "<figcaption>" + escaped(figure.caption) + "</figcaption></figure>\n");
  }
  text.write(how_to_judge);
  text.write("<h2>Settings</h2>\n<details><summary>scene.json</summary><pre>" + escaped(content_of(folder / "scene.json")) +
             "</pre></details>\n</main></body></html>\n");
  text.close();
}

}  // namespace feeler::demo
