// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/checks.h"

#include "app/case_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <utility>

namespace berm::app
{
namespace
{
/// A mistake's text: what a member has from --vary does not come from --set.
std::string as_given(std::string text, const Study& study)
{
  constexpr std::string_view set = "--set ";
  const bool varied = text.starts_with(set) &&
                      std::ranges::none_of(study.overrides, [&](const std::string& fixed)
                                           { return text.substr(set.size()).starts_with(fixed); });
  return varied ? text.replace(0, set.size(), "--vary ") : text;
}

/// Mistakes as told, each with the members that have it.
class MistakeList
{
public:
  void add(const InputError& error, const KeyPlaces& places, const Study& study,
           const std::string& member)
  {
    for (const Mistake& mistake : error.mistakes())
    {
      const std::string text = as_given(describe_one(mistake, places), study);
      auto it = std::ranges::find(list_, text, &std::pair<std::string, Members>::first);
      if (it == list_.end())
        it = list_.insert(list_.end(), {text, {}});
      it->second.push_back(member);
    }
  }
  /// Empty if there are none. What all of `count` members have is the case's, and names none.
  [[nodiscard]] std::string text(std::size_t count) const
  {
    std::string all;
    for (const auto& [text, members] : list_)
    {
      all += text;
      if (members.size() == 1 && count > 1)
        all += "  member: " + members.front() + "\n";
      else if (members.size() < count)
        all += fmt::format("  members: {} of {}, the first {}\n", members.size(), count,
                           members.front());
    }
    if (!list_.empty())
      all += fmt::format("{} {}; nothing was run.\n", list_.size(),
                         list_.size() == 1 ? "mistake" : "mistakes");
    return all;
  }

private:
  using Members = std::vector<std::string>;
  std::vector<std::pair<std::string, Members>> list_;
};

/// The columns that the figures need are there.
void check_reference(const std::string& path)
{
  std::ifstream file(path);
  std::string head;
  if (!std::getline(file, head))
    throw IoError(path + ": cannot be read");
  const std::vector<std::string> names = split_values(head.substr(0, head.find('\r')));
  const auto has = [&](const char* name) { return std::ranges::find(names, name) != names.end(); };
  if (!has("x") || !(has("F") || has("discharge_m2_s")))
    throw InputError(
        {{.key = "--reference " + path,
          .problem = "columns are missing",
          .allowed = "a first line with x, and F or discharge_m2_s; source if it is known",
          .hint = "x is the value of the first key that is varied"}});
}
} // namespace

CheckedMembers check_members(const Study& study, const std::string& reference)
{
  CheckedMembers checked;
  MistakeList mistakes;
  for (const Member& member : study.members)
  {
    KeyPlaces places;
    try
    {
      coupling::Case input =
          read_case(study.case_path, {member.overrides, study.seepage_only}, places);
      checked.title = std::move(input.title);
      checked.figure_formats = std::move(input.output.figure_formats);
    }
    catch (const InputError& error)
    {
      mistakes.add(error, places, study, member.folder);
    }
  }
  checked.mistakes = mistakes.text(study.members.size());
  if (!checked.mistakes.empty())
    return checked;
  if (!reference.empty())
    check_reference(reference);
  return checked;
}
} // namespace berm::app
