// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/toml_document.h"

#include <gtest/gtest.h>

namespace berm::app
{
namespace
{
TomlValue parse(const std::string& text)
{
  KeyPlaces places;
  return parse_toml(text, "f.toml", places);
}

std::vector<std::string> names(const TomlValue& value)
{
  std::vector<std::string> list;
  for (const auto& [name, child] : *value.table())
    list.push_back(name);
  return list;
}

/// The document's text after --set.
std::string after(const std::string& text, const std::vector<std::string>& overrides)
{
  TomlValue document = parse(text);
  KeyPlaces places;
  EXPECT_TRUE(apply_overrides(document, overrides, places).empty());
  return toml_text(document);
}
} // namespace

TEST(TomlDocument, KeepsTheOrderOfTheFile)
{
  const TomlValue document = parse("z = 1\n[soil.sand]\nb = 1\na = 2\n[soil.clay]\n[a]\n");
  EXPECT_EQ(names(document), (std::vector<std::string>{"z", "soil", "a"}));
  const TomlValue& soil = (*document.table())[1].second;
  EXPECT_EQ(names(soil), (std::vector<std::string>{"sand", "clay"}));
  EXPECT_EQ(names((*soil.table())[0].second), (std::vector<std::string>{"b", "a"}));
}

TEST(TomlDocument, KnowsTheLineOfEveryKeyWithAnyLineEnding)
{
  for (const char* text :
       {"a = 1\n\n[t]\nb = [\n1,\n2]\n", "a = 1\r\n\r\n[t]\r\nb = [\r\n1,\r\n2]\r\n",
        "\xEF\xBB\xBF"
        "a = 1\n\n[t]\nb = [\n1,\n2]\n"})
  {
    const TomlValue document = parse(text);
    const TomlValue& t = (*document.table())[1].second;
    EXPECT_EQ((*document.table())[0].second.place, "f.toml:1");
    EXPECT_EQ(t.place, "f.toml:3");
    EXPECT_EQ((*t.table())[0].second.place, "f.toml:4");
  }
}

TEST(TomlDocument, ReportsTheFirstSyntaxErrorWithItsPlace)
{
  const std::string nul("a = 1\n\0", 7);
  for (const std::string& text : {std::string("a = 1\nb = = 2\n"), std::string("a = 1\n[b"),
                                  std::string("a = 1\na = 2\n"), nul})
  {
    KeyPlaces places;
    EXPECT_THROW((void)parse_toml(text, "f.toml", places), InputError) << text;
    EXPECT_TRUE(places.find("").text.starts_with("f.toml:2:")) << places.find("").text;
  }
  KeyPlaces places;
  EXPECT_THROW((void)parse_toml("a = \"\xff\xfe\"", "f.toml", places), InputError) << "not UTF-8";
  EXPECT_THROW((void)parse_toml("a = 1\n\u00fc = 2", "f.toml", places), InputError);
  EXPECT_EQ(places.find("").text, "f.toml:2:1");
}

TEST(TomlDocument, RefusesDocumentsThatAreTooDeepForTheStack)
{
  std::string dotted = "a", brackets, tables;
  for (int i = 0; i < 200000; ++i)
    dotted += ".a";
  brackets = "a = " + std::string(200000, '[');
  for (int i = 0; i < 100000; ++i)
    tables += "{a=";
  for (const std::string& text : {dotted + " = 1", "[" + dotted + "]", brackets, "a = " + tables})
  {
    KeyPlaces places;
    EXPECT_THROW((void)parse_toml(text, "f.toml", places), InputError);
  }
}

TEST(TomlDocument, BearsTheDeepestDocumentThatItLetsThrough)
{
  std::string text = "[a.a.a.a.a.a.a.a]\n";
  for (int i = 0; i < 14; ++i)
    text += "a.a.a.a.a.a.a.a = {";
  text += std::string(14, '}');
  EXPECT_NO_THROW((void)parse(text));
}

TEST(TomlDocument, LetsAnyCharacterStandInTextsAndComments)
{
  const std::string any = std::string(300, '.') + "\u00fc\u4e2d";
  for (const std::string& text :
       {"# " + any, "a = \"" + any + "\"", "a = '" + any + "'",
        "a = \"\"\"\n" + any + "\"\"\"\"\" # " + any, "a = \"\\\"" + any + "\"",
        "a = '''\n'" + any + "\\'''", "\xEF\xBB\xBF# " + any})
    EXPECT_NO_THROW((void)parse(text)) << text;
}

TEST(TomlDocument, LetsNumbersWithPointsBe)
{
  EXPECT_NO_THROW(
      (void)parse("a = 1.5\nb = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0], [9.0, 1.0]]\n"));
}

TEST(TomlDocument, SetReplacesAddsAndCreates)
{
  EXPECT_EQ(after("a = 1", {"a=2"}), "{a = 2}");
  EXPECT_EQ(after("a = 1", {"b.c=[1, 2.5]"}), "{a = 1, b = {c = [1, 2.5]}}");
  EXPECT_EQ(after("", {"a=word", "b=\"two words\"", "c=true", "d=1e5"}),
            "{a = \"word\", b = \"two words\", c = true, d = 100000.0}");
  EXPECT_EQ(after("[[z]]\na=1\n[[z]]\na=2\n", {"z[2].a=3", "z[3].a=4"}),
            "{z = [{a = 1}, {a = 3}, {a = 4}]}");
  EXPECT_EQ(after("", {"a=x=y"}), "{a = \"x=y\"}");
  EXPECT_EQ(after("", {"a="}), "{a = \"\"}");
  EXPECT_EQ(after("", {"a=1\nb=2"}), "{a = \"1?b=2\"}") << "a value cannot bring other keys in";
  EXPECT_EQ(after("a.b = 1", {"a=2", "a.c=3"}), "{a = {c = 3}}");
}

TEST(TomlDocument, SetTellsItsOwnMistakes)
{
  for (const char* text : {"", "=", "=1", "a", "a..b=1", ".a=1", "a.=1", "z[0].a=1", "z[x].a=1",
                           "z[1=1", "z[2].a=1", "z[99999999999999999999].a=1", "z[1]a=1"})
  {
    TomlValue document = parse("");
    KeyPlaces places;
    const auto mistakes = apply_overrides(document, {text}, places);
    ASSERT_EQ(mistakes.size(), 1u) << text;
    EXPECT_TRUE(mistakes[0].key.starts_with("--set")) << text;
  }
}

TEST(TomlDocument, CutsLongValuesBetweenCharacters)
{
  const TomlValue document =
      parse("a = \"" + std::string(54, 'x') + "\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\"");
  const std::string text = toml_text(document);
  EXPECT_LE(text.size(), 63u);
  EXPECT_TRUE(text.ends_with("..."));
  EXPECT_NE(static_cast<unsigned char>(text[text.size() - 4]), 0xC3) << "half a character";
}
} // namespace berm::app
