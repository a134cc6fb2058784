// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace berm::app
{
namespace
{
/// A user's text as it may go to a terminal.
std::string printable(std::string text)
{
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      c = '?';
  return text;
}

std::string text_of(Mistake m, const std::string& place)
{
  m.key = printable(std::move(m.key));
  m.value = printable(std::move(m.value));
  std::string text = place.empty() ? "" : place + ": ";
  if (m.problem == unknown_key || m.problem == missing_key)
    text += m.problem + " " + m.key;
  else
  {
    text += m.key;
    if (!m.value.empty())
      text += (m.key.empty() ? "" : " = ") + m.value;
    if (!m.problem.empty())
      text += (m.key.empty() && m.value.empty() ? "" : ": ") + m.problem;
  }
  text += "\n";
  if (!m.allowed.empty())
    text += "  allowed: " + m.allowed + "\n";
  if (!m.hint.empty())
    text += "  hint: " + m.hint + "\n";
  return text;
}

/// Levenshtein's distance: insertions, deletions, replacements.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const bool same = std::tolower(static_cast<unsigned char>(a[i])) ==
                        std::tolower(static_cast<unsigned char>(b[j]));
      const std::size_t replaced = diagonal + (same ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}
} // namespace

KeyPlaces::Place KeyPlaces::find(std::string_view key) const
{
  while (true)
  {
    const auto it = places_.find(key);
    if (it != places_.end())
      return it->second;
    if (key.empty())
      return {};
    const auto cut = key.find_last_of(".[");
    key = cut == std::string_view::npos ? std::string_view{} : key.substr(0, cut);
  }
}

std::string describe(const std::vector<Mistake>& mistakes, const KeyPlaces& places)
{
  std::vector<std::pair<int, std::string>> texts;
  for (const Mistake& m : mistakes)
  {
    const KeyPlaces::Place place = places.find(m.key);
    texts.emplace_back(place.order, text_of(m, printable(place.text)));
  }
  std::stable_sort(texts.begin(), texts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  constexpr std::size_t most = 200; // to print
  std::string all;
  for (std::size_t i = 0; i < std::min(most, texts.size()); ++i)
    all += texts[i].second;
  if (texts.size() > most)
    all += fmt::format("... and {} more\n", texts.size() - most);
  return all + fmt::format("{} {}; {}.\n", texts.size(), texts.size() == 1 ? "mistake" : "mistakes",
                           places.run_began ? "the run was given up" : "nothing was run");
}

std::string describe_one(const Mistake& mistake, const KeyPlaces& places)
{
  return text_of(mistake, printable(places.find(mistake.key).text));
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates)
{
  if (word.size() > 100)
    return {};
  std::string_view best;
  std::size_t best_distance = 0;
  for (const std::string_view c : candidates)
  {
    // A right stem with a wrong unit ("cohesion_Pa") or a dropped ending ("spacing") is near, too.
    const std::string_view stem = word.substr(0, word.rfind('_'));
    const bool same_stem =
        word.size() >= 4 && (c.starts_with(word) || (stem.size() >= 4 && c.starts_with(stem)));
    const std::size_t d = edit_distance(word, c);
    const std::size_t near = std::max<std::size_t>(2, c.size() / 3);
    if ((d <= near || same_stem) && (best.empty() || d < best_distance))
    {
      best = c;
      best_distance = d;
    }
  }
  return best;
}
} // namespace berm::app
