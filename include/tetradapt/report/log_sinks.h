// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_log_sinks_h
#define tetradapt_report_log_sinks_h

#include "tetradapt/core/descriptor_buffer.h"
#include "tetradapt/core/log.h"

#include <chrono>
#include <iosfwd>
#include <mutex>
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
   * Writes a log's messages to a file as they come, each with the seconds since
   * construction; progress is left out.
   */
  class LogFile
  {
  public:
    /**
     * @param log must outlive the object.
     * @param path a file that does not exist. It may be renamed while the object lives.
     * @throws InputError if it cannot be written.
     */
    LogFile(core::Log &log, const std::string &path);

    ~LogFile();
    LogFile(const LogFile &) = delete;
    LogFile &
    operator=(const LogFile &)
      = delete;

    /** @throws NumericalError if a message could not be written. */
    void
    check();

    /** Closes the file. Later messages are not in it. @throws as check() does. */
    void
    close();

    /** For another thread than the log's, when the process ends at once: writes @p text as
     * the last message, unless a message is just being written and does not end. */
    void
    close_with(const std::string &text);

  private:
    void
    write(core::LogLevel level, const std::string &text);

    core::Log                            &log;
    std::string                           path;
    std::timed_mutex                      mutex; ///< for the buffer
    core::DescriptorBuffer                buffer;
    std::chrono::steady_clock::time_point start;
    unsigned int                          number;
    bool                                  closed = false;
  };
} // namespace tetradapt::report

#endif
