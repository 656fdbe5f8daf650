// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Runs on 1 to 5 ranks give the same energies, errors and estimates, by all estimators, also where
// there are fewer cells than ranks.

#include "program.h"

using namespace program;

namespace
{
  constexpr double tolerance = 1e-8, tolerance_of_bound = 0.03;

  /** The estimators' parts of column names. */
  const std::vector<std::string> estimators{"extrapolation_energy",
                                            "extrapolation_ren",
                                            "exact_energy",
                                            "degree_extrapolation",
                                            "local_degree_extrapolation",
                                            "richardson",
                                            "averaging",
                                            "spr",
                                            "residual",
                                            "interpolation",
                                            "goal",
                                            "equilibrated"};

  const std::vector<std::string> figures{"strain_energy",
                                         "spring_energy",
                                         "energy_error",
                                         "l2_error",
                                         "h1_error",
                                         "mean_ren",
                                         "max_ren",
                                         "max_displacement",
                                         "estimate",
                                         "reference_error_estimate",
                                         "goal_mean",
                                         "goal_mean_error_estimate"};

  double
  distance(const Table &one, const Table &other, const std::string &column)
  {
    double largest = one.n_rows() == other.n_rows() ? 0. : 1e300;
    for (unsigned int row = 0; row < std::min(one.n_rows(), other.n_rows()); ++row)
      {
        const double a = one.value(column, row), b = other.value(column, row);
        if (std::isnan(a) != std::isnan(b))
          return 1e300;
        if (a != b && !std::isnan(a))
          largest = std::max(largest, std::abs(a - b) / std::max(std::abs(a), std::abs(b)));
      }
    return largest;
  }

  /** @p missing: estimators that the scene has no use for. */
  void
  compare(const std::string &name, const std::string &options, const unsigned int missing)
  {
    std::vector<Table> tables;
    for (unsigned int n = 1; n <= 5; ++n)
      {
        const std::string folder = fresh(name + "_" + std::to_string(n)).string();
        const auto        result
          = run("--quiet --output-directory " + folder
                  + " --set Solver/Stopping=residual --set Solver/Type=cg --set "
                    "Solver/Tolerance=1e-10 --set Output/VTU=no "
                  + options,
                "mpirun --allow-run-as-root --oversubscribe -n " + std::to_string(n));
        if (result.code != 0)
          std::cout << name << " on " << n << " ranks: exit code " << result.code << '\n'
                    << result.err;
        tables.emplace_back(folder);
      }
    std::cout << name << ": " << tables[0].n_rows() << " cycles" << std::endl;
    unsigned int n_found = 0, n_equal = 0;
    const auto   look = [&](const std::string &column, const double allowed) {
      if (!tables[0].has(column))
        return false;
      double largest = 0.;
      for (const Table &table : tables)
        largest = std::max(largest, table.has(column) ? distance(tables[0], table, column) : 1e300);
      if (largest <= allowed)
        return true;
      std::cout << "  " << column << " DIFFERS by " << largest << std::endl;
      return false;
    };
    for (const std::string &estimator : estimators)
      {
        const std::string column = "estimate_" + estimator;
        n_found += tables[0].has(column) ? 1 : 0;
        n_equal
          += look(column, estimator == "equilibrated" ? tolerance_of_bound : tolerance) ? 1 : 0;
      }
    check("  all estimators ran", n_found == estimators.size() - missing);
    check("  and agree", n_equal == n_found);
    bool agree = true;
    for (const std::string &figure : figures)
      agree = (!tables[0].has(figure) || look(figure, tolerance)) && agree;
    check("  energies, errors and goals agree", agree);
    if (tables[0].has("energy_error") && tables[0].has("estimate_exact_energy"))
      for (const Table &table : tables)
        if (!(table.last("estimate_equilibrated") >= table.last("energy_error")))
          std::cout << "  the bound is NONE" << std::endl;
  }

  const std::string all       = R"(
subsection Estimation
  set Estimators = energy, ren, exact, degree extrapolation, local degree extrapolation, richardson, averaging, spr, residual, interpolation, goal, equilibrated
end
)",
                    reference = R"(
subsection Reference
  set Type  = fine mesh
  set Size  = 0.4
  set Cache = no
end
)";

  /** A tube with an exact solution, in an elastic bed. */
  void
  tube()
  {
    write("tube.prm",
          "include " + scene("verification/cylinder_on_springs_p1.prm") + all + reference + R"(
subsection Goals
  subsection mean
    set Type      = mean displacement
    set Groups    = outer
    set Component = x
  end
end
subsection Adaptivity
  set Strategy       = uniform
  set Maximum cycles = 3
end
)");
    compare("P1", "tube.prm", 0);
    // The third level, which richardson needs, is left out.
    compare("P2", "--set Degree=2 --set 'Adaptivity/Maximum cycles=2' tube.prm", 1);
  }

  /** Two cells, one of them held and one on springs. */
  void
  two_cells()
  {
    write("two.msh", R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
2
1 4 2 1 1 1 2 3 4
2 4 2 1 1 2 3 4 5
$EndElements
)");
    write("two.prm", R"(
subsection Mesh
  set Type  = file
  set Files = two.msh
end
subsection Materials
  subsection stuff
    set Young modulus = 1000
  end
end
subsection Supports
  subsection wall
    set Where      = x < 1e-9
    set Components = x
  end
  subsection bed
    set Type      = spring
    set Where     = z < 1e-9
    set Stiffness = 300 + 100 * x
    set Direction = all
  end
end
subsection Loads
  subsection pull
    set Where = x + y + z > 1 - 1e-9 && x > y - 1e-9
    set Value = 1; 0; 2
  end
end
subsection Goals
  subsection mean
    set Type      = mean displacement
    set Where     = x + y + z > 1 - 1e-9 && x > y - 1e-9
    set Component = y
  end
end
)" + reference + all);
    for (const std::string degree : {"1", "2"})
      compare(
        "two_cells_P" + degree,
        "--set Degree=" + degree
          + " --set 'Estimation/Estimators=energy, ren, degree extrapolation, local degree "
            "extrapolation, averaging, spr, residual, interpolation, goal, equilibrated' two.prm",
        2);
  }
} // namespace

int
main()
{
  tube();
  two_cells();
}
