// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/tetgen_process.h"

#include "tetradapt/core/child_process.h"
#include "tetradapt/core/exceptions.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    using core::NumericalError;

    /** The last lines of what TetGen printed, as the end of a message. */
    std::string
    last_words(const std::string &errors)
    {
      std::istringstream       stream(errors);
      std::vector<std::string> lines;
      for (std::string line; std::getline(stream, line);)
        if (line.find_first_not_of(" \t\r") != std::string::npos)
          lines.push_back(line);
      if (lines.empty())
        return "";
      std::string text = " TetGen's last output:";
      for (std::size_t i = lines.size() > 3 ? lines.size() - 3 : 0; i < lines.size(); ++i)
        text += "\n  " + lines[i];
      return text;
    }

    /** TetGen walks through many small pieces of memory: large pages, which the C library
     * asks for where it knows these settings, save it a twelfth of its time. */
    constexpr char memory_settings[]
      = "GLIBC_TUNABLES=glibc.malloc.hugetlb=1:"
        "glibc.malloc.mmap_threshold=1073741824:glibc.malloc.trim_threshold=2147483648";

    std::string
    number(double x)
    {
      std::ostringstream stream;
      stream << x;
      return stream.str();
    }

    std::string
    signal_name(int signal)
    {
      switch (signal)
        {
        case SIGSEGV:
          return "SIGSEGV";
        case SIGABRT:
          return "SIGABRT";
        case SIGFPE:
          return "SIGFPE";
        case SIGBUS:
          return "SIGBUS";
        case SIGILL:
          return "SIGILL";
        case SIGKILL:
          return "SIGKILL";
        case SIGTERM:
          return "SIGTERM";
        case SIGINT:
          return "SIGINT";
        case SIGHUP:
          return "SIGHUP";
        default:
          return "signal " + std::to_string(signal);
        }
    }

    /** Whether a program gets @p signal by its own mistake. */
    bool
    is_crash(const int signal)
    {
      return signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE || signal == SIGILL
             || signal == SIGABRT;
    }

    [[noreturn]] void
    fail_memory(const std::string &what, const TetgenLimits &limits)
    {
      throw NumericalError("TetGen ran out of memory on " + what + " (limit "
                           + number(limits.memory)
                           + " MiB). Ask for larger tetrahedra or raise TetGen/Memory limit.");
    }

    [[noreturn]] void
    fail_time(const std::string &what, const TetgenLimits &limits)
    {
      throw NumericalError("TetGen did not finish " + what + " within " + number(limits.time)
                           + " s. Ask for larger tetrahedra, relax the quality bounds or raise "
                             "TetGen/Time limit.");
    }

    /** What to say of a child that @p signal ended. */
    [[noreturn]] void
    fail_by_signal(const std::string  &what,
                   const TetgenLimits &limits,
                   const int           signal,
                   const std::string  &errors)
    {
      if (signal == SIGXCPU)
        fail_time(what, limits);
      const std::string name = " (" + signal_name(signal) + ')';
      if (is_crash(signal))
        throw NumericalError("TetGen crashed" + name + " on " + what
                             + ". That is a fault of TetGen that some bodies and sizes bring "
                               "about: change the wanted size slightly, or remove tiny edges and "
                               "faces from the surface."
                             + last_words(errors));
      if (signal == SIGKILL)
        throw NumericalError("TetGen was killed" + name + " while it worked on " + what
                             + ". The system does so when the memory of the machine, of a "
                               "container or of a batch job is used up: ask for larger "
                               "tetrahedra, or set TetGen/Memory limit below what there is.");
      throw NumericalError("TetGen was ended from outside" + name + " while it worked on " + what
                           + ". Nothing is wrong with the input; start the run again.");
    }

    /** Explains a child that ended without a whole reply. */
    [[noreturn]] void
    fail_without_reply(const std::string  &what,
                       const TetgenLimits &limits,
                       int                 status,
                       const std::string  &errors)
    {
      std::string how    = "ended without a mesh";
      std::string advice = "The input may touch or cross itself within rounding: repair it, or "
                           "change the wanted size slightly.";
      if (status >= 0 && WIFSIGNALED(status))
        fail_by_signal(what, limits, WTERMSIG(status), errors);
      if (status >= 0 && WIFEXITED(status) && WEXITSTATUS(status) == 127)
        {
          how    = "could not be started";
          advice = "Build or install the program tetradapt-tetgen again.";
        }
      throw NumericalError("TetGen " + how + " on " + what + ". " + advice + last_words(errors));
    }

    /** What TetGen's codes mean: see terminatetetgen() in tetgen.h. */
    std::string
    tetgen_code(int code)
    {
      switch (code)
        {
        case 2:
          return "met an internal error. Change the wanted size or the quality bounds slightly";
        case 3:
          return "found that the surface crosses itself. Repair the surface";
        case 4:
          return "found a detail too small to be resolved. Remove points that nearly coincide";
        case 5:
          return "found two facets that nearly coincide. Remove one or move them apart";
        default:
          return "refused its input. Check that the surface is closed and free of degenerate "
                 "facets";
        }
    }

    /** Turns a failure that the child reported into an exception. */
    void
    check_reply(const TetgenReply  &reply,
                const std::string  &what,
                const TetgenLimits &limits,
                const std::string  &errors)
    {
      switch (reply.status)
        {
        case TetgenStatus::done:
          return;
        case TetgenStatus::out_of_memory:
          fail_memory(what, limits);
        case TetgenStatus::tetgen_error:
          throw NumericalError("TetGen gave up on " + what + ": it "
                               + tetgen_code(reply.tetgen_code) + '.' + last_words(errors));
        default:
          throw NumericalError("TetGen was given an unusable request for " + what + ": "
                               + reply.message + '.');
        }
    }

    bool
    is_executable(const std::string &path)
    {
      return !path.empty() && access(path.c_str(), X_OK) == 0;
    }

    std::string
    next_to_this_program()
    {
      std::string   path(4096, '\0');
      const ssize_t n = readlink("/proc/self/exe", path.data(), path.size());
      if (n <= 0)
        return "";
      path.resize(n);
      return path.substr(0, path.rfind('/') + 1) + "tetradapt-tetgen";
    }
  } // namespace

  std::string
  find_tetgen_worker()
  {
    if (const char *named = std::getenv("TETRADAPT_TETGEN_WORKER"))
      {
        if (is_executable(named))
          return named;
        throw NumericalError(std::string("The environment variable TETRADAPT_TETGEN_WORKER names "
                                         "the program '")
                             + named + "', which does not exist or cannot be executed.");
      }
    const std::string neighbour = next_to_this_program();
    if (is_executable(neighbour))
      return neighbour;
#ifdef TETRADAPT_TETGEN_WORKER_PATH
    if (is_executable(TETRADAPT_TETGEN_WORKER_PATH))
      return TETRADAPT_TETGEN_WORKER_PATH;
#endif
    throw NumericalError("The program tetradapt-tetgen, in which TetGen runs, is missing: it was "
                         "looked for at '"
                         + neighbour
                         + "'. Put it there, or name it in the environment variable "
                           "TETRADAPT_TETGEN_WORKER.");
  }

  TetgenReply
  run_tetgen(const TetgenRequest &request, const TetgenLimits &limits, const std::string &what)
  {
    const std::string worker = find_tetgen_worker();
    TetgenWriter      writer;
    TetgenHeader      header;
    writer.bytes.assign(sizeof(header), '\0');
    transfer_request(writer, request);
    header.memory_limit
      = static_cast<std::uint64_t>(std::clamp(limits.memory, 1., 1e12) * 1048576.);
    // The wall clock is watched here; this limit serves if this process dies.
    header.cpu_limit = static_cast<std::uint64_t>(std::ceil(std::clamp(limits.time, 0., 1e9))) + 2;
    header.payload_size = writer.bytes.size() - sizeof(header);
    std::memcpy(writer.bytes.data(), &header, sizeof(header));

    const core::ChildResult result
      = core::run_child({"tetradapt-tetgen", worker, {}, {memory_settings}},
                        writer.bytes,
                        limits.time);
    if (result.timed_out)
      fail_time(what, limits);

    TetgenReply  reply;
    TetgenHeader answer;
    answer.magic = 0;
    if (result.output.size() >= sizeof(answer))
      std::memcpy(&answer, result.output.data(), sizeof(answer));
    if (answer.magic != TetgenHeader::current_magic
        || answer.payload_size != result.output.size() - sizeof(answer))
      fail_without_reply(what, limits, result.status, result.errors);
    TetgenReader reader(result.output, sizeof(answer));
    read_reply(reader, reply);
    check_reply(reply, what, limits, result.errors);
    return reply;
  }
} // namespace tetradapt::mesh
