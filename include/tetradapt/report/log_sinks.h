// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_log_sinks_h
#define tetradapt_report_log_sinks_h

#include "tetradapt/core/atomic_file.h"
#include "tetradapt/core/log.h"

#include <chrono>
#include <iosfwd>
#include <string>

namespace tetradapt::report
{
  /**
   * Shows a log's messages on a stream, normally stderr; details only where they are
   * asked for. Warnings and errors are broken into lines on terminals only, so that a file
   * has each in one line. Progress is one line that
   * the next message replaces; it is for terminals and never goes to a file.
   * Watches from construction to destruction.
   */
  class TerminalSink
  {
  public:
    struct Options
    {
      /** Whether the stream is a terminal that can rewrite a line. */
      bool is_terminal = false;
      /** Warnings and errors only. */
      bool quiet = false;
      /** No information, but progress, warnings and errors. */
      bool brief = false;
      /** Details also. */
      bool verbose = false;
      /** Longer progress lines are cut, longer lines of information broken, at 80 also. */
      unsigned int width = 80;
      /** Progress that differs from the line before only in its numbers and comes
       * sooner, in seconds, is dropped, so that an iteration may report every step.
       * A new stage is always shown: it may be one that takes long. */
      double min_interval = 0.1;
      /** Whether progress starts with the seconds since construction. */
      bool show_time = false;
    };

    /** @p log and @p stream must outlive the object. */
    TerminalSink(core::Log &log, std::ostream &stream, const Options &options);
    ~TerminalSink();
    TerminalSink(const TerminalSink &) = delete;
    TerminalSink &
    operator=(const TerminalSink &)
      = delete;

    /** Options for stderr as it is: whether it is a terminal, and how wide. */
    static Options
    stderr_options(bool quiet);

  private:
    void
    show(core::LogLevel level, const std::string &text);
    bool
    is_shown(core::LogLevel level) const;
    void
    show_progress(const std::string &text);
    void
    clear_progress();

    using Clock = std::chrono::steady_clock;
    core::Log        &log;
    std::ostream     &stream;
    Options           options;
    unsigned int      number;
    bool              progress_is_shown = false;
    std::string       last_stage; ///< the line that is shown, without its digits
    Clock::time_point last_progress;
    Clock::time_point start = Clock::now();
  };

  /**
   * Writes a log's messages to a file, each with the seconds since construction;
   * progress is left out. The file appears when the object is closed or destroyed,
   * also while an exception is passing: to have an error in it, let the object
   * live until the error has been sent to the log.
   */
  class LogFile
  {
  public:
    /** @p log must outlive the object. @throws InputError if @p path cannot be
     * written. */
    LogFile(core::Log &log, const std::string &path);

    /** Closes; here a full disk costs the file, without a message. */
    ~LogFile();
    LogFile(const LogFile &) = delete;
    LogFile &
    operator=(const LogFile &)
      = delete;

    /** Gives the file its name. Later messages are not in it.
     * @throws NumericalError if it could not be written. */
    void
    close();

  private:
    void
    write(core::LogLevel level, const std::string &text);

    core::Log                            &log;
    core::AtomicFile                      file;
    std::chrono::steady_clock::time_point start;
    unsigned int                          number;
    bool                                  closed = false;
  };
} // namespace tetradapt::report

#endif
