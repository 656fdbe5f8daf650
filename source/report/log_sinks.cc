// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/log_sinks.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/printable.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ostream>

namespace tetradapt::report
{
  namespace
  {
    const char *
    label(const core::LogLevel level)
    {
      switch (level)
        {
        case core::LogLevel::warning:
          return "Warning: ";
        case core::LogLevel::error:
          return "Error: ";
        default:
          return "";
        }
    }

    /** The first line of @p text, at most @p width bytes of it, not cut within a
     * UTF-8 character. */
    std::string
    one_line(const std::string &text, const std::size_t width)
    {
      std::size_t length = std::min(text.find('\n'), text.size());
      if (length > width)
        for (length = width; length > 0 && (text[length] & 0xC0) == 0x80;)
          --length;
      return text.substr(0, length);
    }

    /** @p text with lines of at most @p width characters of UTF-8: those that are longer are
     * broken at blanks and go on two characters to the right. Words stay whole. */
    std::string
    broken(const std::string &text, const std::size_t width)
    {
      std::string result;
      std::size_t column = 0, blank = std::string::npos;
      for (const char c : text)
        {
          if (c == '\n')
            {
              column = 0;
              blank  = std::string::npos;
            }
          else
            {
              column += (c & 0xC0) != 0x80;
              // Blanks at a line's beginning indent it.
              if (c == ' ' && column > 1 && result.back() != ' ')
                blank = result.size();
            }
          result += c;
          if (column > width && blank != std::string::npos)
            {
              std::size_t rest = 0;
              for (std::size_t i = blank + 1; i < result.size(); ++i)
                rest += (result[i] & 0xC0) != 0x80;
              result.replace(blank, 1, "\n  ");
              column = rest + 2;
              blank  = std::string::npos;
            }
        }
      return result;
    }

    /** What tells one stage's progress from another's: the words. */
    std::string
    without_numbers(const std::string &text)
    {
      std::string words;
      for (const char c : text)
        if (std::string("0123456789.+-e").find(c) == std::string::npos)
          words += c;
      return words;
    }

    std::string
    seconds_text(const double seconds)
    {
      char text[40];
      std::snprintf(text, sizeof text, "[%.1f s] ", seconds);
      return text;
    }
    /** A message as it stands in a log file. */
    std::string
    entry(const core::LogLevel                        level,
          const std::string                          &text,
          const std::chrono::steady_clock::time_point start)
    {
      char time[40];
      std::snprintf(
        time,
        sizeof time,
        "[%10.3f s] ",
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      // Lines of a table stay below each other.
      std::string aligned;
      for (const char c : core::printable(text))
        {
          aligned += c;
          if (c == '\n')
            aligned += "               ";
        }
      return time + (label(level) + aligned) + "\n";
    }
  } // namespace

  TerminalSink::TerminalSink(core::Log &log, std::ostream &stream, const Options &options)
    : log(log), stream(stream), options(options),
      number(log.add_sink(
        [this](const core::LogLevel level, const std::string &text) { show(level, text); }))
  {
  }

  TerminalSink::~TerminalSink()
  {
    clear_progress();
    log.remove_sink(number);
  }

  TerminalSink::Options
  TerminalSink::stderr_options(const bool quiet)
  {
    Options     options;
    const char *terminal = std::getenv("TERM");
    options.quiet        = quiet;
    options.show_time    = true;
    options.is_terminal
      = ::isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string(terminal) != "dumb";
    winsize size{};
    if (options.is_terminal && ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
      options.width = size.ws_col;
    return options;
  }

  void
  TerminalSink::show(const core::LogLevel level, const std::string &text)
  {
    if (level == core::LogLevel::progress)
      show_progress(text);
    else if (is_shown(level))
      {
        clear_progress();
        const std::string whole     = label(level) + core::printable(text);
        const bool        is_broken = level == core::LogLevel::info || options.is_terminal;
        stream << (is_broken ? broken(whole, std::min(80u, options.width)) : whole) << std::endl;
      }
  }

  bool
  TerminalSink::is_shown(const core::LogLevel level) const
  {
    if (level == core::LogLevel::warning || level == core::LogLevel::error)
      return true;
    return !options.quiet && !options.brief && (level != core::LogLevel::detail || options.verbose);
  }

  void
  TerminalSink::show_progress(const std::string &text)
  {
    if (!options.is_terminal || options.quiet)
      return;
    if (text.empty())
      {
        clear_progress();
        return;
      }
    const auto        now   = Clock::now();
    const std::string stage = without_numbers(text.substr(0, text.find('\n')));
    if (progress_is_shown && stage == last_stage
        && std::chrono::duration<double>(now - last_progress).count() < options.min_interval)
      return;
    // The last column stays free: some terminals wrap when it is written to.
    const std::string time
      = options.show_time ? seconds_text(std::chrono::duration<double>(now - start).count()) : "";
    stream << "\r\033[K"
           << one_line(time + core::printable(text), options.width > 1 ? options.width - 1 : 1)
           << std::flush;
    progress_is_shown = true;
    last_stage        = stage;
    last_progress     = now;
  }

  void
  TerminalSink::clear_progress()
  {
    if (progress_is_shown)
      stream << "\r\033[K" << std::flush;
    progress_is_shown = false;
  }

  LogFile::LogFile(core::Log &log, const std::string &path)
    : log(log), path(path), start(std::chrono::steady_clock::now()),
      number(log.add_sink(
        [this](const core::LogLevel level, const std::string &text) { write(level, text); }))
  {
    const int error = buffer.create(path);
    if (error == 0)
      return;
    log.remove_sink(number);
    throw core::InputError("Cannot write the file '" + path + "': " + std::strerror(error)
                           + ". Make room there, or choose another output directory.");
  }

  LogFile::~LogFile()
  {
    if (!closed)
      log.remove_sink(number);
  }

  void
  LogFile::check()
  {
    if (buffer.error() != 0)
      throw core::NumericalError("Cannot write the file '" + path
                                 + "': " + std::strerror(buffer.error())
                                 + ". Make room on the disk or choose another output directory.");
  }

  void
  LogFile::close()
  {
    if (!closed)
      {
        const std::lock_guard<std::timed_mutex> guard(mutex);
        closed = true;
        log.remove_sink(number);
        buffer.close();
      }
    check();
  }

  void
  LogFile::close_with(const std::string &text)
  {
    const std::unique_lock<std::timed_mutex> lock(mutex, std::chrono::milliseconds(100));
    if (!lock || closed)
      return;
    const std::string line = entry(core::LogLevel::error, text, start);
    buffer.sputn(line.data(), line.size());
    buffer.close();
  }

  void
  LogFile::write(const core::LogLevel level, const std::string &text)
  {
    if (level == core::LogLevel::progress)
      return;
    const std::string                       line = entry(level, text, start);
    const std::lock_guard<std::timed_mutex> guard(mutex);
    buffer.sputn(line.data(), line.size());
    buffer.pubsync();
  }
} // namespace tetradapt::report
