// berm: slope safety with the water where it really is.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace berm
{
/// One mistake in what the user gave: where, what, what would be allowed, and a hint.
struct Mistake
{
  std::string key = {};     ///< path of the key in the case file, e.g. "soil.fill.cohesion_kPa"
  std::string value = {};   ///< what was given, as text; empty if nothing was
  std::string problem = {}; ///< what is wrong, one clause
  std::string allowed = {}; ///< what is allowed; empty if `problem` says it
  std::string hint = {};    ///< what to do next; may be empty
};

/// The user's input is wrong; carries every mistake that was found. Exit code 2.
class InputError : public std::runtime_error
{
public:
  explicit InputError(std::vector<Mistake> mistakes)
      : std::runtime_error(summary(mistakes)), mistakes_(std::move(mistakes))
  {
  }
  [[nodiscard]] const std::vector<Mistake>& mistakes() const { return mistakes_; }

private:
  static std::string summary(const std::vector<Mistake>& mistakes)
  {
    std::string text;
    for (const Mistake& m : mistakes)
      text += m.key + (m.value.empty() ? "" : " = " + m.value) + ": " + m.problem + "\n";
    return text;
  }
  std::vector<Mistake> mistakes_;
};

/// A solve or a search ended without an answer; the last iterate is not one. Exit code 3.
class NotConverged : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A result holds NaN or infinity; the text names field, step, place. Exit code 3.
class NumericalError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A file cannot be read or written; the text names it. Exit code 4.
class IoError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace berm
