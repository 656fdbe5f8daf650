// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/interrupt_watcher.h"

#include "tetradapt/core/exceptions.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

namespace tetradapt::core
{
  namespace
  {
    /** How long the end waits for files that are being written. mpirun kills its processes
     * a second after it has asked them to end. */
    constexpr std::chrono::milliseconds patience(700);

    constexpr std::array<int, 3> signals{{SIGINT, SIGTERM, SIGHUP}};

    /** What the handler writes to, which can be handed to it in no other way. */
    std::atomic<int>  handler_pipe{-1};
    std::atomic<bool> has_arrived{false};

    extern "C" void
    note_signal(const int signal)
    {
      const int           error  = errno;
      const unsigned char number = static_cast<unsigned char>(signal);
      has_arrived                = true;
      if (::write(handler_pipe, &number, 1) < 0)
        ::_exit(128 + signal);
      errno = error;
    }
  } // namespace

  class InterruptWatcher::Implementation
  {
  public:
    explicit Implementation(Action usual) : usual(std::move(usual))
    {
      if (::pipe2(ends, O_CLOEXEC) != 0)
        throw NumericalError(std::string("No pipe is left: ") + std::strerror(errno) + '.');
      handler_pipe = ends[1];
      watcher      = std::thread([this]() { watch(); });
      for (std::size_t i = 0; i < signals.size(); ++i)
        {
          struct sigaction action = {};
          action.sa_handler       = note_signal;
          action.sa_flags         = SA_RESTART;
          sigemptyset(&action.sa_mask);
          ::sigaction(signals[i], nullptr, &before[i]);
          if (before[i].sa_handler != SIG_IGN)
            ::sigaction(signals[i], &action, nullptr);
        }
    }

    ~Implementation()
    {
      for (std::size_t i = 0; i < signals.size(); ++i)
        if (before[i].sa_handler != SIG_IGN)
          ::sigaction(signals[i], &before[i], nullptr);
      handler_pipe = -1;
      ::close(ends[1]); // a signal that came in time is still read
      watcher.join();
      ::close(ends[0]);
    }

    std::timed_mutex output;
    std::mutex       action_mutex;
    Action           action;

  private:
    void
    watch()
    {
      unsigned char signal = 0;
      ssize_t       n      = 0;
      do
        n = ::read(ends[0], &signal, 1);
      while (n < 0 && errno == EINTR);
      if (n != 1)
        return;
      // Whatever hangs below, a second signal ends it.
      std::thread([this, signal]() {
        unsigned char second;
        ssize_t       m = 0;
        do
          m = ::read(ends[0], &second, 1);
        while (m < 0 && errno == EINTR);
        if (m == 1)
          ::_exit(128 + signal);
      }).detach();
      // Not given back: what is being written when patience ends is not waited for.
      const bool is_locked = output.try_lock_for(patience);
      (void)is_locked;
      {
        const std::lock_guard<std::mutex> guard(action_mutex);
        const Action                     &chosen = action ? action : usual;
        if (chosen)
          chosen(signal);
      }
      ::_exit(128 + signal);
    }

    const Action                                 usual;
    int                                          ends[2] = {-1, -1};
    std::array<struct sigaction, signals.size()> before;
    std::thread                                  watcher;
  };

  InterruptWatcher::InterruptWatcher(Action usual)
    : implementation(std::make_unique<Implementation>(std::move(usual)))
  {
  }

  InterruptWatcher::~InterruptWatcher() = default;

  void
  InterruptWatcher::set_action(Action action)
  {
    const std::lock_guard<std::mutex> guard(implementation->action_mutex);
    implementation->action = std::move(action);
  }

  std::unique_lock<std::timed_mutex>
  InterruptWatcher::defer()
  {
    return std::unique_lock<std::timed_mutex>(implementation->output);
  }

  bool
  InterruptWatcher::is_ending() const
  {
    return has_arrived;
  }

  void
  InterruptWatcher::wait_if_ending() const
  {
    while (is_ending())
      std::this_thread::sleep_for(std::chrono::seconds(1));
  }

  std::string
  InterruptWatcher::signal_name(const int signal)
  {
    switch (signal)
      {
      case SIGINT:
        return "SIGINT (Ctrl-C)";
      case SIGTERM:
        return "SIGTERM";
      case SIGHUP:
        return "SIGHUP (the terminal was closed)";
      default:
        return "signal " + std::to_string(signal);
      }
  }
} // namespace tetradapt::core
