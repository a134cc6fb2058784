// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace berm
{
/// What a run tells while it goes on. No module prints: the caller supplies an observer.
/// Every member has an empty default, so `Observer{}` is a silent one.
class Observer
{
public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  /// A stage of the straight path begins, e.g. "seepage", "settling", "strength reduction".
  virtual void stage(std::string_view /*name*/) {}
  /// A line for the log: a finished trial, a Newton history, a mesh size.
  virtual void note(std::string_view /*text*/) {}
  /// A line for whoever looks for a cause, e.g. each Newton step. Called often.
  virtual void detail(std::string_view /*text*/) {}
  /// Something doubtful but legal.
  virtual void warn(std::string_view /*text*/) {}
  /// How far the present stage is, in [0, 1], and a short text on what is being done. Called often.
  virtual void progress(double /*fraction*/, std::string_view /*text*/) {}
  /// True once the user asked to stop: long loops end cleanly and say that they did.
  [[nodiscard]] virtual bool stop_requested() const { return false; }
};
} // namespace berm
