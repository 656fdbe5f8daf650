// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The report's uniform meshes of a beam: its counts, and an error that falls with
// the thickness of the beam in cells.

#include "program.h"

using namespace program;

int
main()
{
  fresh("output"); // kept references
  const fs::path folder = fresh("table");
  const auto     result = run("--quiet --output-directory table " + scene("report/table_4_1.prm"));
  std::cout << "exit code " << result.code << std::endl;
  const Table table(folder);
  for (unsigned int row = 0; row < table.n_rows(); ++row)
    std::cout << table.value("points", row) << " points, " << table.value("tets", row)
              << " tetrahedra" << std::endl;

  // First rows with 1, 2, 3, 4 and 6 cells across, and the last row of the one before.
  const unsigned int thickness[] = {1, 1, 2, 2, 3, 3, 4, 6};
  for (unsigned int row = 1; row < 8; ++row)
    if (thickness[row] != thickness[row - 1])
      check("mean REN lower with " + std::to_string(thickness[row]) + " cells than with "
              + std::to_string(thickness[row - 1]),
            table.value("mean_ren", row) < table.value("mean_ren", row - 1)
              && (row < 2 || table.value("mean_ren", row) < table.value("mean_ren", row - 2)));
  check("no effectivity, without an exact solution", std::isnan(table.value("effectivity", 0)));
  check("the reference against itself: nothing", table.value("mean_ren", 8) < 1e-9);
  check("a rough reference is called so", contains(result.err, "rough"));
  check("no success where it meets itself", contains(result.err, "measure the reference's error"));
}
