// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli_pages.h"

#include "app/case_schema.h"
#include "app/version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace berm::app
{
namespace
{
std::vector<const CLI::App*> commands(const CLI::App& app)
{
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// "--out" and the like; empty for a positional.
std::string name_of(const CLI::Option& option)
{
  return option.get_lnames().empty() ? "" : "--" + option.get_lnames().front();
}

/// The words that an option takes: "a b" of a type that CLI11 calls "TEXT:{a,b}".
std::string choices(const CLI::Option& option)
{
  const std::string type = option.get_type_name();
  const auto open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos)
    return {};
  std::string words = type.substr(open + 1, close - open - 1);
  std::ranges::replace(words, ',', ' ');
  return words;
}

/// What stands for an option's value: "DIR", "a|b"; empty for a flag.
std::string value_of(const CLI::Option& option)
{
  if (std::string words = choices(option); !words.empty())
  {
    std::ranges::replace(words, ' ', '|');
    return words;
  }
  const std::string type = option.get_type_name();
  return option.get_expected_max() == 0 ? "" : type.substr(0, type.find(':'));
}

/// Keys that have one path; soils and elements of arrays have a name or number first.
std::string plain_keys()
{
  std::vector<std::string> list;
  for (const Key& key : keys())
    if (key.path.find_first_of("*[") == std::string_view::npos)
      list.push_back(std::string(key.path) + "=");
  return fmt::format("{}", fmt::join(list, " "));
}

/// Text between single quotes of zsh, in which `marks` mean something to its completion.
std::string zsh_text(std::string_view text, std::string_view marks)
{
  std::string out;
  for (const char c : text)
    if (c == '\'')
      out += "'\\''";
    else
      out += (marks.find(c) == std::string_view::npos ? "" : "\\") + std::string(1, c);
  return out;
}

/// An option or positional as zsh's _arguments takes it: '*--set[Replace
/// ...]:KEY=VALUE:_berm_keys'.
std::string zsh_argument(const CLI::Option& option)
{
  const std::string name = name_of(option), words = choices(option), value = value_of(option);
  const std::string repeats = option.get_items_expected_max() > 1 ? "*" : "";
  std::string text = name.empty()
                         ? ":" + option.get_name()
                         : repeats + name + "[" + zsh_text(option.get_description(), "\\[]:") + "]";
  if (!name.empty() && value.empty())
    return "'" + text + "'"; // a flag
  if (!name.empty())
    text += ":" + zsh_text(value, "\\:");
  if (!words.empty())
    text += ":(" + words + ")";
  else if (value.starts_with("KEY="))
    text += ":_berm_keys";
  else
    text += value == "N" ? ": " : ":_files";
  return "'" + text + "'";
}

/// Text for man: a backslash and a dot that begins a line mean something there, and so does "-".
std::string roff(std::string_view text)
{
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text)
    out += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
  return out;
}

void add_option(std::string& page, const CLI::Option& option)
{
  const std::string name = name_of(option), value = value_of(option);
  const std::string head = name.empty() ? "\\fI" + roff(option.get_name()) + "\\fR"
                                        : "\\fB" + roff(name) + "\\fR" +
                                              (value.empty() ? "" : " \\fI" + roff(value) + "\\fR");
  page += ".TP\n" + head + "\n" + roff(option.get_description()) + "\n";
}
} // namespace

std::string bash_completion(const CLI::App& app)
{
  std::vector<std::string> names;
  std::string values, options;
  for (const CLI::App* command : commands(app))
  {
    names.push_back(command->get_name());
    std::vector<std::string> list;
    for (const CLI::Option* option : command->get_options())
    {
      const std::string name = name_of(*option), words = choices(*option);
      if (!name.empty())
        list.push_back(name);
      const std::string before = name.empty() ? command->get_name() : name;
      if (!words.empty())
        fmt::format_to(std::back_inserter(values), "    \"{} {}\") words=\"{}\" ;;\n",
                       command->get_name(), before, words);
    }
    fmt::format_to(std::back_inserter(options), "      {}) words=\"{}\" ;;\n", command->get_name(),
                   fmt::join(list, " "));
  }
  return fmt::format(R"(# Completion of berm for bash, written by `berm completion bash`.
#   berm completion bash > ~/.local/share/bash-completion/completions/berm
_berm() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}} $before" in
{}    *" --set" | *" --vary")
      COMPREPLY=($(compgen -W "{}" -- "$word"))
      compopt -o nospace 2>/dev/null
      return ;;
  esac
  if [ -z "$words" ] && [[ $word == -* ]]; then
    case "${{COMP_WORDS[1]}}" in
{}    esac
  fi
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
  else
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -F _berm berm
)",
                     fmt::join(names, " "), values, plain_keys(), options);
}

std::string zsh_completion(const CLI::App& app)
{
  std::string names, arguments;
  for (const CLI::App* command : commands(app))
  {
    fmt::format_to(std::back_inserter(names), "    '{}:{}'\n", command->get_name(),
                   zsh_text(command->get_description(), "\\:"));
    std::vector<std::string> list;
    for (const CLI::Option* option : command->get_options())
      list.push_back(zsh_argument(*option));
    fmt::format_to(std::back_inserter(arguments), "    {})\n      _arguments {} ;;\n",
                   command->get_name(), fmt::join(list, " \\\n        "));
  }
  return fmt::format(R"(#compdef berm
# Completion of berm for zsh, written by `berm completion zsh`; a file _berm in a folder of $fpath.
_berm_keys() {{
  compadd -S '' -- {}
}}
_berm() {{
  local command=$words[2]
  local -a commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
if [[ $funcstack[1] == _berm ]]; then
  _berm "$@"
else
  compdef _berm berm
fi
)",
                     plain_keys(), names, arguments);
}

std::string man_page(const CLI::App& app)
{
  std::string page = fmt::format(".TH BERM 1 \"\" \"berm {}\" \"User Commands\"\n", version());
  page += ".SH NAME\nberm \\- seepage and stability of embankments\n"
          ".SH SYNOPSIS\n\\fBberm\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR ...]\n"
          ".SH DESCRIPTION\n"
          "Takes a section, its soils and its pools from a case file (TOML) and finds the phreatic "
          "surface, the factor of safety, the slip surface, and where the soil goes if it fails. "
          "Results are files in a directory, and a report on standard output.\n"
          ".SH COMMANDS\n";
  for (const CLI::App* command : commands(app))
  {
    page += fmt::format(".SS berm {}\n{}.\n", roff(command->get_name()),
                        roff(command->get_description()));
    for (const CLI::Option* option : command->get_options())
      if (option != command->get_help_ptr())
        add_option(page, *option);
  }
  page += ".SH EXIT STATUS\n";
  const std::vector<std::pair<int, const char*>> codes = {
      {0, "Done."},
      {1, "A bug in berm."},
      {2, "Bad input; nothing was run."},
      {3, "No answer: not converged, undecided, stopped on request."},
      {4, "A file cannot be read or written."}};
  for (const auto& [code, meaning] : codes)
    page += fmt::format(".TP\n.B {}\n{}\n", code, meaning);
  page += ".SH ENVIRONMENT\n.TP\n.B OMP_NUM_THREADS\nThreads of the particle loops, unless "
          "\\fB\\-\\-threads\\fR or the case says how many.\n"
          ".SH EXAMPLES\n.nf\n"
          "berm init dam \\-\\-template dam_with_core\n"
          "berm run dam.toml\n"
          "berm study dam.toml \\-\\-vary water.left_level_m=15:21:4\n.fi\n";
  return page;
}
} // namespace berm::app
