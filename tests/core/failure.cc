// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What one rank throws is thrown on all, whatever it is, as an InputError or NumericalError with
// the message of the first rank that failed.

#include "tetradapt/core/failure.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>
#include <new>

using namespace tetradapt;

namespace
{
  unsigned int rank = 0, n_ranks = 1;

  std::string
  kind_of(const std::function<void()> &action)
  {
    const core::Failure failure = core::attempt(action);
    const std::string   kind    = failure.kind == core::Failure::none    ? "no failure"
                                  : failure.kind == core::Failure::input ? "input"
                                                                         : "numerical";
    return kind + (failure.message.empty() ? "" : ": ") + failure.message;
  }

  /** Throws on one rank only, or on two of them. */
  void
  check(const std::string &what, const std::function<void()> &action)
  {
    for (unsigned int failing = 0; failing < n_ranks; ++failing)
      {
        const std::string here = kind_of([&] {
          core::together(MPI_COMM_WORLD, [&] {
            if (rank == failing)
              action();
            else if (rank > failing)
              throw core::NumericalError("a later rank failed also");
          });
        });
        const auto        all  = dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, here);
        bool              same = true;
        for (const std::string &other : all)
          same = same && other == here;
        if (rank == 0)
          std::cout << what << " on rank " << failing << ": " << here
                    << (same ? "" : " ON THIS RANK ONLY") << '\n';
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);

  check("nothing", [] {});
  check("InputError", [] { throw core::InputError("a wrong value"); });
  check("NumericalError", [] { throw core::NumericalError("no convergence"); });
  check("bad_alloc", [] { throw std::bad_alloc(); });
  check("int", [] { throw 7; });
  check("const char *", [] { throw "text"; });
  check("exception of deal.II", [] { throw dealii::ExcMessage("something is wrong"); });
  check("file", [] {
    throw std::filesystem::filesystem_error("",
                                            "name",
                                            std::make_error_code(std::errc::filename_too_long));
  });
  const std::string on_first
    = kind_of([] { core::on_first_rank(MPI_COMM_WORLD, [] { throw std::bad_alloc(); }); });
  const auto all = dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, on_first);
  if (rank == 0)
    std::cout << "on the first rank, seen by the last: " << all.back() << '\n';
}
