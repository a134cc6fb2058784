// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/design.h"

#include "app/case_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace berm::app
{
namespace
{
constexpr std::size_t most_members = 9999;
constexpr std::size_t base_value = static_cast<std::size_t>(-1);

/// Which value each variation has in a member.
using Choice = std::vector<std::size_t>;

std::vector<Choice> choices_of_grid(const std::vector<Variation>& variations)
{
  std::vector<Choice> choices{{}};
  for (const Variation& variation : variations)
  {
    std::vector<Choice> longer;
    if (choices.size() * variation.values.size() > most_members)
      throw InputError({{.key = "--vary",
                         .problem = "the grid has too many members",
                         .allowed = fmt::format("at most {}", most_members),
                         .hint = "--pairs and --one-at-a-time have fewer"}});
    for (const Choice& choice : choices)
      for (std::size_t k = 0; k < variation.values.size(); ++k)
      {
        longer.push_back(choice);
        longer.back().push_back(k);
      }
    choices = std::move(longer);
  }
  return choices;
}

std::vector<Choice> choices_of_pairs(const std::vector<Variation>& variations)
{
  std::vector<Choice> choices;
  const std::size_t count = variations.front().values.size();
  for (const Variation& variation : variations)
    if (variation.values.size() != count)
      throw InputError(
          {{.key = "--vary " + variation.name(),
            .value = fmt::format("{} values", variation.values.size()),
            .problem = "--pairs takes the same number of values of each",
            .allowed = fmt::format("{}, as of {}", count, variations.front().name())}});
  for (std::size_t k = 0; k < count; ++k)
    choices.emplace_back(variations.size(), k);
  return choices;
}

/// A value that is the case's own is the base, and not computed again.
std::vector<Choice> choices_one_at_a_time(const std::vector<Variation>& variations,
                                          const std::vector<std::string>& base)
{
  std::vector<Choice> choices{Choice(variations.size(), base_value)};
  for (std::size_t v = 0; v < variations.size(); ++v)
    for (std::size_t k = 0; k < variations[v].values.size(); ++k)
    {
      if (same_value(variations[v].values[k], base[v]))
        continue;
      choices.push_back(choices.front());
      choices.back()[v] = k;
    }
  return choices;
}

/// "003_cohesion_kPa_10": a number, then what is varied, of characters that every shell leaves
/// alone.
std::string folder_name(std::size_t number, const std::vector<Variation>& variations,
                        const Choice& choice)
{
  constexpr std::size_t most = 60;
  std::string words;
  for (std::size_t v = 0; v < variations.size(); ++v)
    if (choice[v] != base_value)
      words += fmt::format("_{}_{}", last_part(variations[v].keys.front()),
                           variations[v].values[choice[v]]);
  if (words.empty())
    words += "_base";
  std::string name;
  for (const char c : words)
  {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '-' || c == '.';
    if (kept)
      name += c;
    else if (!name.ends_with('_'))
      name += '_';
  }
  name.resize(std::min(name.size(), most));
  return fmt::format("members/{:03}{}", number, name);
}
} // namespace

std::string_view to_string(Design design)
{
  return design == Design::grid ? "grid" : design == Design::pairs ? "pairs" : "one-at-a-time";
}

std::vector<Member> members(const std::vector<Variation>& variations, Design design,
                            const std::vector<std::string>& fixed,
                            const std::vector<std::string>& base)
{
  const std::vector<Choice> choices = design == Design::grid ? choices_of_grid(variations)
                                      : design == Design::pairs
                                          ? choices_of_pairs(variations)
                                          : choices_one_at_a_time(variations, base);
  std::vector<Member> list;
  for (const Choice& choice : choices)
  {
    Member member;
    member.folder = folder_name(list.size() + 1, variations, choice);
    member.overrides = fixed;
    for (std::size_t v = 0; v < variations.size(); ++v)
    {
      const bool varied = choice[v] != base_value;
      member.varied.push_back(varied);
      member.values.push_back(varied ? variations[v].values[choice[v]] : base[v]);
      if (varied)
        for (const std::string& key : variations[v].keys)
          member.overrides.push_back(key + "=" + member.values.back());
    }
    list.push_back(std::move(member));
  }
  return list;
}
} // namespace berm::app
