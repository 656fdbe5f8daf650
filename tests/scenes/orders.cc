// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The manufactured solution: errors fall with the orders that theory gives.

#include "program.h"

using namespace program;

namespace
{
  void
  order(const Table &table, const std::string &column, const double exact)
  {
    const unsigned int n = table.n_rows();
    // Edges halve from cycle to cycle.
    const double order = std::log2(table.value(column, n - 2) / table.value(column, n - 1));
    const bool   good  = std::abs(order - exact) < 0.1;
    std::cout << "  order of " << column << " within 0.1 of " << exact << ": ";
    if (good)
      std::cout << "yes" << std::endl;
    else
      std::cout << "NO, " << order << std::endl;
  }

  void
  degree(const unsigned int degree, const unsigned int cycles)
  {
    const std::string name   = "manufactured_p" + std::to_string(degree);
    const fs::path    folder = fresh(name);
    const auto        result
      = run("--quiet --output-directory " + name + " " + scene("verification/" + name + ".prm"));
    // The displacements of this solution are large: they are warned of.
    std::cout << name << ": exit code " << result.code << '\n'
              << (result.code == 0 ? "" : result.err);
    const Table table(folder);
    check("  " + std::to_string(cycles) + " cycles", table.n_rows() == cycles);
    // 2, 4, 8, ... bricks a side.
    for (unsigned int row = 0; row < table.n_rows(); ++row)
      std::cout << "  " << table.value("points", row) << " points, " << table.value("tets", row)
                << " tetrahedra, " << table.value("dofs", row) << " unknowns" << std::endl;
    order(table, "relative_energy_error", degree);
    order(table, "energy_error", degree);
    order(table, "relative_h1_error", degree);
    order(table, "relative_l2_error", degree + 1);
    // (lambda (div u)^2 + 2 mu eps:eps)/2 with int (div u)^2 = 4 pi^2/8 and
    // int eps:eps = (6 + 5) pi^2/8, from the diagonal and from beside it.
    const double pi    = 3.14159265358979324;
    const double exact = 0.5 * (1.5 * 4. + 2. * 11.) * pi * pi / 8.;
    const double error = table.last("relative_energy_error");
    check("  strain energy right to the square of the error",
          std::abs(table.last("strain_energy") / exact - 1.) < error * error);
  }
} // namespace

int
main()
{
  degree(1, 5);
  degree(2, 4);
}
