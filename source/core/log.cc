// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/log.h"

#include <algorithm>
#include <utility>

namespace tetradapt::core
{
  unsigned int
  Log::add_sink(Sink sink)
  {
    sinks.emplace_back(next_number, std::move(sink));
    return next_number++;
  }

  void
  Log::remove_sink(const unsigned int number)
  {
    sinks.erase(std::remove_if(sinks.begin(),
                               sinks.end(),
                               [number](const auto &entry) { return entry.first == number; }),
                sinks.end());
  }

  Log
  Log::with_progress_prefix(const std::string &prefix) const
  {
    Log log             = *this;
    log.progress_prefix = prefix;
    return log;
  }

  void
  Log::progress(const std::string &text) const
  {
    // An empty text takes the line away.
    send(LogLevel::progress, text.empty() ? text : progress_prefix + text);
  }

  void
  Log::detail(const std::string &text) const
  {
    send(LogLevel::detail, text);
  }

  void
  Log::info(const std::string &text) const
  {
    send(LogLevel::info, text);
  }

  void
  Log::warning(const std::string &text) const
  {
    send(LogLevel::warning, text);
  }

  void
  Log::error(const std::string &text) const
  {
    send(LogLevel::error, text);
  }

  void
  Log::send(const LogLevel level, const std::string &text) const
  {
    for (const auto &entry : sinks)
      entry.second(level, text);
  }
} // namespace tetradapt::core
