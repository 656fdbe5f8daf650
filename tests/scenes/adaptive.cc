// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Adaptive runs: the error falls, the estimator knows it, two ranks do what one
// does, and the cantilever needs no more tetrahedra than it should.

#include "program.h"

using namespace program;

namespace
{
  void
  quickstart()
  {
    std::cout << "quickstart" << std::endl;
    const std::string prm = scene("quickstart.prm"), quiet = "--quiet --output-directory ";
    const auto        result = run("--output-directory " + fresh("one").string() + " " + prm);
    const Table       table("one");
    check("  done", result.code == 0 && table.n_rows() == 5);
    check("  the table is printed", contains(result.out, "ref. diff."));
    check("  messages are not", !contains(result.out, "Cycle"));
    check("  energy error falls in every cycle", table.falls("relative_energy_error"));
    check("  L2 error falls in every cycle", table.falls("relative_l2_error"));
    check("  to less than half",
          table.last("relative_energy_error") < 0.5 * table.value("relative_energy_error", 0));
    std::cout << "  " << files("one") << std::endl;

    // No cache: each solves its own reference.
    const std::string cg     = "--set Solver/Type=cg --set Reference/Cache=no --set "
                               "Solver/Tolerance=1e-12 --set 'Reference/Size=0.2' ";
    const auto        serial = run(quiet + fresh("serial").string() + " " + cg + prm);
    const auto        two    = run(quiet + fresh("two").string() + " " + cg + prm, "mpirun -np 2");
    check("  with two ranks", serial.code == 0 && two.code == 0);
    check("  two ranks are mentioned", contains(read("two/log.txt"), "2 MPI rank"));
    check("  the same figures to 1e-6", Table("serial").distance(Table("two")) < 1e-6);
  }

  /** The scene with a reference that takes a second, and a known energy. */
  Table
  cantilever(const unsigned int degree, const std::string &settings)
  {
    const std::string name = "cantilever_p" + std::to_string(degree);
    const auto        result
      = run("--quiet --output-directory " + fresh(name).string() + " " + settings
            + " --set 'Reference/Size=min(0.4, 0.025 + 0.3*sqrt(x^2 + min(y,1-y,z,1-z)^2))' "
            + scene("verification/" + name + ".prm"));
    std::cout << name << ": exit code " << result.code << std::endl;
    return Table(name);
  }

  /** Whether some row has at most so many tetrahedra and so large a true error. */
  void
  bar(const Table &table, const unsigned int tets, const std::string &column, const double error)
  {
    bool reached = false;
    for (unsigned int row = 0; row < table.n_rows(); ++row)
      reached = reached || (table.value("tets", row) < tets && table.value(column, row) < error);
    std::cout << "  ";
    check(column + " below " + std::to_string(error).substr(0, 5) + " with less than "
            + std::to_string(tets) + " tetrahedra",
          reached);
  }

  void
  effectivity(const Table &table)
  {
    unsigned int n = 0, n_good = 0;
    for (unsigned int row = 0; row < table.n_rows(); ++row)
      if (3. * table.value("reference_error_estimate", row)
          <= table.value("relative_energy_error", row))
        {
          ++n;
          const double e = table.value("effectivity", row);
          n_good += e >= 0.9 && e <= 1.1;
        }
    check("  effectivity of 0.9 to 1.1 where the reference is good (3 rows at least)",
          n >= 3 && n_good == n);
  }
} // namespace

int
main()
{
  fresh("output"); // kept references
  quickstart();
  const Table quadratic = cantilever(2, "--set 'Adaptivity/Maximum tetrahedra=1800'");
  bar(quadratic, 330, "relative_energy_error", 0.06);
  bar(quadratic, 1800, "relative_energy_error", 0.027);
  bar(quadratic, 400, "mean_ren", 0.01);
  effectivity(quadratic);
  const Table linear = cantilever(1, "--set 'Adaptivity/Maximum tetrahedra=12000'");
  check("  with the reference kept from the other degree",
        contains(read("cantilever_p1/log.txt"), "Reference: reused"));
  bar(linear, 5000, "relative_energy_error", 0.35);
  bar(linear, 13000, "relative_energy_error", 0.27);
  effectivity(linear);
}
