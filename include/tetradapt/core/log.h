// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_log_h
#define tetradapt_core_log_h

#include <functional>
#include <string>
#include <vector>

namespace tetradapt::core
{
  /** What a message is, so that each sink can decide what to show. */
  enum class LogLevel
  {
    progress, ///< replaced by the next one; for terminals only
    detail,   ///< for the log file, and for terminals on request
    info,
    warning,
    error
  };

  /**
   * Distributes messages to sinks (the terminal, log.txt). Passed by reference
   * to whatever has something to say; there is no global log. On every MPI rank
   * but the first no sink is added, so that each message appears once.
   */
  class Log
  {
  public:
    using Sink = std::function<void(LogLevel, const std::string &)>;

    /** Adds @p sink and returns a number by which it can be removed. */
    unsigned int
    add_sink(Sink sink);
    void
    remove_sink(unsigned int number);

    /** A log with the same sinks that puts @p prefix before progress messages: what
     * it is handed to need not know which cycle it works for. Use it no longer than
     * the sinks are there. */
    Log
    with_progress_prefix(const std::string &prefix) const;

    void
    progress(const std::string &text) const;
    void
    detail(const std::string &text) const;
    void
    info(const std::string &text) const;
    void
    warning(const std::string &text) const;
    void
    error(const std::string &text) const;

  private:
    void
    send(LogLevel level, const std::string &text) const;

    std::vector<std::pair<unsigned int, Sink>> sinks;
    unsigned int                               next_number = 0;
    std::string                                progress_prefix;
  };
} // namespace tetradapt::core

#endif
