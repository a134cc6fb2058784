// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/console.h"

#include "core/error.h"

#include <fmt/format.h>

#include <sys/ioctl.h>

#include <algorithm>
#include <cmath>
#include <csignal>

namespace berm::app
{
namespace
{
volatile std::sig_atomic_t stop_signals = 0;

extern "C" void on_stop_signal(int signal)
{
  if (stop_signals != 0)
  {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  stop_signals = 1;
}

std::size_t terminal_width(std::FILE* stream)
{
  winsize size{};
  const bool known = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}
} // namespace

void catch_stop_signals()
{
  std::signal(SIGINT, on_stop_signal);
  std::signal(SIGTERM, on_stop_signal);
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error like a full disk
}

Console::Console(std::FILE* stream, bool terminal, Volume volume, const std::filesystem::path& log)
    : stream_(stream), terminal_(terminal), volume_(volume)
{
  if (log.empty())
    return;
  log_.open(log);
  if (!log_)
    throw IoError("--log " + log.string() + ": cannot be opened for writing");
}

Console::~Console()
{
  clear_bar();
}

bool Console::stop_requested() const
{
  return stop_signals != 0;
}

void Console::stage(std::string_view name)
{
  stage_ = name;
  stage_watch_ = {};
  last_shown_ = terminal_ ? -1e9 : 0;
  line(name);
}

void Console::note(std::string_view text)
{
  line(fmt::format("  {}", text));
}

void Console::detail(std::string_view text)
{
  line(fmt::format("  {}", text), Volume::verbose);
}

void Console::warn(std::string_view text)
{
  warnings_.emplace_back(text);
  line(fmt::format("  warning: {}", text));
}

void Console::progress(double fraction, std::string_view text)
{
  const double shown_every = terminal_ ? 0.1 : 60; // [s]
  const double now = stage_watch_.elapsed().wall;
  if (volume_ == Volume::quiet || now - last_shown_ < shown_every)
    return;
  last_shown_ = now;
  const double done = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  std::string left;
  if (done > 0.02 && now > 1)
    left = fmt::format(", {} left", duration_text(now * (1 - done) / done));
  if (!terminal_)
  {
    fmt::print(stream_, "  {:.0f} %{}: {}\n", 100 * done, left, text);
    std::fflush(stream_);
    return;
  }
  constexpr int cells = 24;
  const int full = static_cast<int>(std::lround(done * cells));
  std::string bar = fmt::format(
      "{} [{}{}] {:3.0f} %{}  {}", stage_, std::string(static_cast<std::size_t>(full), '#'),
      std::string(static_cast<std::size_t>(cells - full), '.'), 100 * done, left, text);
  bar.resize(std::min(bar.size(), terminal_width(stream_) - 1));
  fmt::print(stream_, "\r\x1b[K{}", bar);
  std::fflush(stream_);
  bar_shown_ = true;
}

void Console::clear_bar()
{
  if (bar_shown_)
    fmt::print(stream_, "\r\x1b[K");
  bar_shown_ = false;
}

void Console::line(std::string_view text, Volume from)
{
  if (log_.is_open())
    log_ << fmt::format("{:9.2f} s  {}\n", watch_.elapsed().wall, text) << std::flush;
  if (volume_ < from)
    return;
  clear_bar();
  fmt::print(stream_, "{}\n", text);
  std::fflush(stream_);
}

std::string duration_text(double seconds)
{
  const auto s = static_cast<long>(std::lround(std::clamp(seconds, 0.0, 1e7)));
  if (s < 60)
    return fmt::format("{} s", s);
  if (s < 3600)
    return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}
} // namespace berm::app
