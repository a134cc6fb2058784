// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/html_report.h"

#include "app/packed_array.h"
#include "app/report_data.h"
#include "app/run_writer.h"
#include "app/version.h"
#include "core/error.h"

#include <string_view>

#ifdef BERM_WITH_REPORT
// The page's parts as bundled by esbuild, byte for byte.
#define BERM_EMBED(name, file)                                                                     \
  asm(".section .rodata\n" #name ":\n.incbin \"" file "\"\n" #name "_end:\n.byte 0\n.previous\n"); \
  extern "C" const char name[], name##_end[]

BERM_EMBED(berm_page_html, BERM_PAGE "/index.html");
BERM_EMBED(berm_page_style, BERM_PAGE "/style.css");
BERM_EMBED(berm_page_script, BERM_PAGE "/page.js");
#endif

namespace berm::app
{
namespace
{
/// The template's parts; empty in a build without them.
struct Parts
{
  std::string_view html, style, script;
};

Parts parts()
{
#ifdef BERM_WITH_REPORT
  return {{berm_page_html, berm_page_html_end},
          {berm_page_style, berm_page_style_end},
          {berm_page_script, berm_page_script_end}};
#else
  return {};
#endif
}

/// JSON that cannot end the script element that holds it.
std::string inert(const Json& data)
{
  const std::string json = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(json.size() + json.size() / 16);
  for (const char c : json)
    if (c == '<') // only ever within a text
      text += "\\u003c";
    else
      text += c;
  return text;
}

void replace(std::string& page, std::string_view mark, std::string_view text)
{
  page.replace(page.find(mark), mark.size(), text);
}
} // namespace

bool report_built_in()
{
  return !parts().html.empty();
}

std::string report_page(const Json& data)
{
  const Parts p = parts();
  std::string page(p.html);
  // From the end of the page to its beginning: what was put in is not searched again.
  replace(page, "@SCRIPT@", p.script);
  replace(page, "@DATA@", inert(data));
  replace(page, "@STYLE@", p.style);
  replace(page, "@SCRIPT_HASH@", base64(sha256(p.script)));
  return page;
}

void write_report(const std::filesystem::path& directory, bool foreign)
{
  if (!report_built_in())
    throw IoError("no report: berm was built without its page (BERM_WITH_REPORT)");
  Json data = foreign ? foreign_report_data(directory) : report_data(directory);
  data["version"] = version_text();
  write_aside(directory / "report.html", report_page(data));
  if (data["kind"] == "comparison")
    for (const Json& water : data["comparison"]["waters"])
      write_report(directory /
                       std::filesystem::path(water.at("directory").get<std::string>()).filename(),
                   foreign);
}
} // namespace berm::app
