// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/failure.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"

#include <deal.II/base/exceptions.h>

#include <filesystem>
#include <new>
#include <sstream>

namespace tetradapt::core
{
  namespace
  {
    /** The sentence of a deal.II exception, without its frame and stack. */
    std::string
    text_of(const dealii::ExceptionBase &error)
    {
      std::ostringstream info;
      error.print_info(info);
      std::istringstream words(info.str());
      std::string        text, word;
      while (words >> word)
        text += (text.empty() ? "" : " ") + word;
      const std::string name = error.get_exc_name();
      return name + (name.empty() || text.empty() ? "" : ": ") + text;
    }
  } // namespace

  void
  Failure::rethrow() const
  {
    if (kind == input)
      throw InputError(message);
    if (kind == numerical)
      throw NumericalError(message);
  }

  Failure
  attempt(const std::function<void()> &work)
  {
    try
      {
        work();
        return {};
      }
    catch (const InputError &error)
      {
        return {Failure::input, error.what()};
      }
    catch (const NumericalError &error)
      {
        return {Failure::numerical, error.what()};
      }
    catch (const std::filesystem::filesystem_error &error)
      {
        // Names that are too long, links in a circle, folders that may not be read.
        const bool is_trouble = error.code() == std::errc::no_space_on_device
                                || error.code() == std::errc::io_error
                                || error.code() == std::errc::too_many_files_open;
        return {is_trouble ? Failure::numerical : Failure::input,
                "'" + error.path1().string() + "': " + error.code().message() + "."};
      }
    catch (const std::bad_alloc &)
      {
        return {Failure::numerical,
                "there is not enough memory. Use a smaller mesh: see Mesh, Reference and "
                "Adaptivity/Maximum tetrahedra."};
      }
    catch (const dealii::ExceptionBase &error)
      {
        return {Failure::numerical, "unexpected failure in deal.II: " + text_of(error)};
      }
    catch (const std::exception &error)
      {
        return {Failure::numerical, std::string("unexpected failure: ") + error.what()};
      }
    catch (const int number) // as Trilinos throws them
      {
        return {Failure::numerical, "unexpected failure, number " + std::to_string(number)};
      }
    catch (...)
      {
        return {Failure::numerical, "unexpected failure of an unknown kind"};
      }
  }

  void
  together(MPI_Comm communicator, const std::function<void()> &work)
  {
    if (is_alone(communicator))
      return work();
    int rank = 0, n_ranks = 1;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);
    Failure failure = attempt(work);
    int     first   = failure.kind == Failure::none ? n_ranks : rank;
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, communicator);
    if (first == n_ranks)
      return;
    int numbers[2] = {failure.kind, static_cast<int>(failure.message.size())};
    MPI_Bcast(numbers, 2, MPI_INT, first, communicator);
    failure.kind = static_cast<Failure::Kind>(numbers[0]);
    failure.message.resize(numbers[1]);
    MPI_Bcast(failure.message.data(), numbers[1], MPI_CHAR, first, communicator);
    failure.rethrow();
  }
} // namespace tetradapt::core
