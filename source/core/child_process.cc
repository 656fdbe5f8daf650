// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/child_process.h"

#include "tetradapt/core/exceptions.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>

extern char **environ;

namespace tetradapt::core
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    [[noreturn]] void
    fail_to_start(const std::string &what, int error)
    {
      throw NumericalError("A program cannot be started: " + what + ": " + std::strerror(error)
                           + '.');
    }

    /** Owns a file descriptor. */
    class Descriptor
    {
    public:
      Descriptor()                   = default;
      Descriptor(const Descriptor &) = delete;
      Descriptor &
      operator=(const Descriptor &)
        = delete;
      ~Descriptor()
      {
        close();
      }

      /** Takes @p descriptor over, moved above the three standard ones, which the
       * child's are made of. */
      void
      take(int descriptor)
      {
        close();
        number = descriptor;
        if (number >= 0 && number <= 2)
          {
            number = fcntl(descriptor, F_DUPFD_CLOEXEC, 3);
            ::close(descriptor);
          }
        if (number < 0)
          fail_to_start("no file descriptor is left", errno);
      }
      void
      close()
      {
        if (number >= 0)
          ::close(number);
        number = -1;
      }
      int
      get() const
      {
        return number;
      }

    private:
      int number = -1;
    };

    /** A running child; killed and collected by the destructor if it still runs. */
    class Child
    {
    public:
      Child(const ChildProgram &program, int channel, int errors)
      {
        posix_spawn_file_actions_t actions;
        posix_spawnattr_t          attributes;
        posix_spawn_file_actions_init(&actions);
        posix_spawnattr_init(&attributes);
        posix_spawn_file_actions_adddup2(&actions, channel, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, channel, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 34)
        // Libraries such as MPI leave descriptors open that are not close-on-exec.
        posix_spawn_file_actions_addclosefrom_np(&actions, 3);
#endif
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

        std::vector<std::string> texts{program.name};
        texts.insert(texts.end(), program.arguments.begin(), program.arguments.end());
        std::vector<char *> arguments;
        for (std::string &text : texts)
          arguments.push_back(text.data());
        arguments.push_back(nullptr);
        std::vector<std::string> added = program.environment;
        std::vector<char *>      variables;
        for (char **variable = environ; variable != nullptr && *variable != nullptr; ++variable)
          variables.push_back(*variable);
        for (std::string &variable : added)
          if (std::getenv(variable.substr(0, variable.find('=')).c_str()) == nullptr)
            variables.push_back(variable.data());
        variables.push_back(nullptr);
        const int error = posix_spawn(
          &pid, program.path.c_str(), &actions, &attributes, arguments.data(), variables.data());
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
        if (error != 0)
          {
            pid = -1;
            fail_to_start(program.name + " (" + program.path + ")", error);
          }
      }
      Child(const Child &) = delete;
      Child &
      operator=(const Child &)
        = delete;
      ~Child()
      {
        if (pid > 0)
          {
            kill();
            wait();
          }
      }

      void
      kill()
      {
        if (pid > 0)
          ::kill(pid, SIGKILL);
      }

      /** Waits for the end; returns the status of waitpid(), or -1 if somebody
       * else (a handler of SIGCHLD) collected it first. */
      int
      wait()
      {
        int   status = 0;
        pid_t result;
        do
          result = waitpid(pid, &status, 0);
        while (result < 0 && errno == EINTR);
        pid = -1;
        return result < 0 ? -1 : status;
      }

    private:
      pid_t pid = -1;
    };

    /** Sends what the socket takes; returns false when the other side is gone. */
    bool
    send_some(int channel, const char *&data, std::size_t &size)
    {
      // MSG_NOSIGNAL: a child that died must not kill the program by SIGPIPE.
      const ssize_t n = send(channel, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (n >= 0)
        {
          data += n;
          size -= n;
          return true;
        }
      return errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK;
    }

    /** Reads what is there; returns false at the end of the stream. */
    bool
    receive_some(int descriptor, std::string &bytes, std::vector<char> &buffer)
    {
      const ssize_t n = read(descriptor, buffer.data(), buffer.size());
      if (n > 0)
        bytes.append(buffer.data(), n);
      return n > 0 || (n < 0 && (errno == EINTR || errno == EAGAIN));
    }

    /** Milliseconds until @p deadline, for poll(). */
    int
    remaining(Clock::time_point deadline)
    {
      const auto left
        = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
      return static_cast<int>(std::clamp<long long>(left + 1, 0, 3'600'000));
    }

    /** Sends @p input and reads until the child closes both streams. */
    ChildResult
    exchange(int channel, int errors, const std::string &input, Clock::time_point deadline)
    {
      constexpr std::size_t kept_errors = 4096;

      ChildResult       result;
      std::vector<char> buffer(1 << 20);
      const char       *data         = input.data();
      std::size_t       size         = input.size();
      bool              channel_open = true, errors_open = true;
      while (channel_open || errors_open)
        {
          if (Clock::now() >= deadline)
            {
              result.timed_out = true;
              break;
            }
          pollfd requests[2]
            = {{channel_open ? channel : -1, POLLIN, 0}, {errors_open ? errors : -1, POLLIN, 0}};
          if (size > 0)
            requests[0].events |= POLLOUT;
          if (poll(requests, 2, remaining(deadline)) < 0)
            {
              if (errno == EINTR)
                continue;
              break;
            }
          // What the child said before it died is worth reading, so a broken
          // channel is read to its end rather than left.
          if ((requests[0].revents & POLLOUT) != 0)
            {
              if (!send_some(channel, data, size))
                size = 0;
              if (size == 0)
                shutdown(channel, SHUT_WR); // a child that reads too much sees the end
            }
          if ((requests[0].revents & (POLLIN | POLLHUP | POLLERR)) != 0)
            channel_open = receive_some(channel, result.output, buffer);
          if ((requests[1].revents & (POLLIN | POLLHUP | POLLERR)) != 0)
            errors_open = receive_some(errors, result.errors, buffer);
          if (result.errors.size() > 2 * kept_errors)
            result.errors.erase(0, result.errors.size() - kept_errors);
        }
      return result;
    }
  } // namespace

  ChildResult
  run_child(const ChildProgram &program, const std::string &input, double time_limit)
  {
    const auto deadline
      = Clock::now()
        + std::chrono::microseconds(static_cast<long long>(1e6 * std::clamp(time_limit, 0., 1e9)));
    Descriptor channel, child_channel, errors, child_errors;
    int        pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
      fail_to_start(program.name + ", no socket is left", errno);
    channel.take(pair[0]);
    child_channel.take(pair[1]);
    if (pipe2(pair, O_CLOEXEC) != 0)
      fail_to_start(program.name + ", no pipe is left", errno);
    errors.take(pair[0]);
    child_errors.take(pair[1]);

    Child child(program, child_channel.get(), child_errors.get());
    child_channel.close();
    child_errors.close();
    ChildResult result = exchange(channel.get(), errors.get(), input, deadline);
    if (result.timed_out)
      child.kill();
    channel.close();
    result.status = child.wait();
    return result;
  }
} // namespace tetradapt::core
