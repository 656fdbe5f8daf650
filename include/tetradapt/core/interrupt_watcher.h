// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_interrupt_watcher_h
#define tetradapt_core_interrupt_watcher_h

#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace tetradapt::core
{
  /**
   * Ends the process in good order when SIGINT (Ctrl-C), SIGTERM or SIGHUP arrives: a thread
   * waits for what their handler notes, calls the action that is set at the time, and ends
   * the process with the exit code 128 + the signal's number. The computation need not
   * look for signals, and ends at once wherever it is.
   *
   * A second signal ends the process without the action. A signal that was ignored when
   * the object was made (nohup, a shell's background jobs) stays ignored. At most one
   * object at a time.
   */
  class InterruptWatcher
  {
  public:
    /** Is called with the signal's number, in a thread of its own, while the rest of the
     * program still runs. */
    using Action = std::function<void(int signal)>;

    /** @param usual what is done while no other action is set. */
    explicit InterruptWatcher(Action usual);
    ~InterruptWatcher();
    InterruptWatcher(const InterruptWatcher &) = delete;
    InterruptWatcher &
    operator=(const InterruptWatcher &)
      = delete;

    /** Replaces the action; an empty one stands for the usual one. Waits while an action
     * runs. */
    void
    set_action(Action action);

    /** While what is returned lives, the action and the end wait, for up to a second:
     * files that belong together are written together. */
    std::unique_lock<std::timed_mutex>
    defer();

    /** Whether a signal has arrived: what failed since may have failed because of it. */
    bool
    is_ending() const;

    /** If a signal has arrived, waits for the end and does not return. */
    void
    wait_if_ending() const;

    /** "SIGINT (Ctrl-C)", "SIGTERM", or "signal 7". */
    static std::string
    signal_name(int signal);

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace tetradapt::core

#endif
