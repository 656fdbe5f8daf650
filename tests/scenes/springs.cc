// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Springs in whole runs: orders of convergence and all estimators against exact solutions, on plane
// and on curved walls, with a displaced ground; ranks; and what is refused.

#include "program.h"

using namespace program;

namespace
{
  const std::string tight
    = "--set Solver/Stopping=residual --set Solver/Tolerance=1e-12 --set Reference/Cache=no ";

  Table
  solve(const std::string &name,
        const std::string &file,
        const std::string &overrides,
        const std::string &before = "")
  {
    const fs::path folder = fresh(name);
    const auto     result
      = run("--quiet --output-directory " + name + " --set Output/VTU=no " + overrides + " " + file,
            before);
    std::cout << name << ": exit code " << result.code << '\n'
              << (result.code == 0 ? "" : result.err);
    return Table(folder);
  }

  void
  within(const std::string &what, const double value, const double lower, const double upper)
  {
    const bool good = value >= lower && value <= upper;
    check("  " + what, good);
    if (!good)
      std::cout << "    " << value << ", not from " << lower << " to " << upper << std::endl;
  }

  /** The exponent s in error ~ h^s, with as many unknowns as h^-3, in the last refinement. */
  double
  order(const Table &table, const std::string &column)
  {
    const unsigned int last = table.n_rows() - 1;
    return 3. * std::log(table.value(column, last - 1) / table.value(column, last))
           / std::log(table.value("dofs", last) / table.value("dofs", last - 1));
  }

  const std::vector<std::string> estimators{"spr",
                                            "averaging",
                                            "residual",
                                            "interpolation",
                                            "degree_extrapolation",
                                            "local_degree_extrapolation",
                                            "equilibrated"};

  std::string
  all_estimators()
  {
    return "--set 'Estimation/Estimators=spr, averaging, residual, interpolation, degree "
           "extrapolation, local degree extrapolation, equilibrated' ";
  }

  void
  effectivities(const Table &table, const double lower, const double upper)
  {
    for (const std::string &name : estimators)
      within("effectivity of " + name,
             table.last("effectivity_" + name),
             name == "equilibrated" ? 1. : lower,
             name == "equilibrated" ? 2.5 : upper);
  }

  /** Against the same solution without springs, which errors hardly differ from. */
  void
  manufactured(const unsigned int degree)
  {
    const std::string p = degree == 1 ? "_p1" : "_p2";
    const std::string cycles
      = "--set 'Adaptivity/Maximum cycles=" + std::to_string(5 - degree) + "' ";
    const Table table = solve("manufactured" + p,
                              scene("verification/manufactured_on_springs" + p + ".prm"),
                              tight + cycles + all_estimators());
    within("order in energy", order(table, "relative_energy_error"), degree - 0.15, degree + 0.35);
    within("order in L2", order(table, "relative_l2_error"), degree + 0.7, degree + 1.5);
    effectivities(table, 0.75, 1.3);
    write("goal.prm", "include " + scene("verification/manufactured_goals.prm") + R"(
subsection Supports
  subsection five sides
    set Groups = x-min, y-min, z-min
  end
  subsection bed
    set Type         = spring
    set Groups       = x-max
    set Stiffness    = if(y < 0.4, 1, 5)
    set Direction    = all
    set Displacement = -5*pi*cos(pi*y)*cos(pi*z)/if(y < 0.4, 1, 5); \
                       -2*sin(pi*y)*cos(pi*z); cos(pi*y)*sin(pi*z)
  end
  subsection wall
    set Groups       = y-max
    set Displacement = sin(pi*x)*cos(pi*y)*cos(pi*z); \
                       2*cos(pi*x)*sin(pi*y)*cos(pi*z); \
                       -cos(pi*x)*cos(pi*y)*sin(pi*z)
  end
end
)");
    const Table goal
      = solve("goal" + p,
              "goal.prm",
              tight + "--set 'Adaptivity/Maximum cycles=3' --set Estimation/Goal=face "
                + "--set Degree=" + std::to_string(degree));
    within("effectivity of a goal, stiffness with a jump",
           goal.last("goal_face_effectivity"),
           0.9,
           1.1);
  }

  void
  cylinder(const unsigned int degree)
  {
    const std::string p     = degree == 1 ? "_p1" : "_p2";
    const Table       table = solve("cylinder" + p,
                              scene("verification/cylinder_on_springs" + p + ".prm"),
                              "--set 'Adaptivity/Maximum tetrahedra=8000' " + all_estimators());
    check("  error falls in every cycle", table.falls("relative_energy_error"));
    within("order in energy", order(table, "relative_energy_error"), degree - 0.5, degree + 0.6);
    effectivities(table, 0.7, 1.4);
  }

  /** Bernoulli's beam on Winkler's foundation sinks by 0.24720, Timoshenko's by 0.25075. */
  void
  beam()
  {
    const Table table = solve("beam",
                              scene("loads/beam_on_elastic_foundation.prm"),
                              "--set 'Adaptivity/Maximum cycles=2'");
    within("sinks as a beam does", table.last("goal_sinks"), -0.2535, -0.2480);
    within("the goal's error is estimated as small",
           std::abs(table.last("goal_sinks_error_estimate") / table.last("goal_sinks")),
           0.,
           1e-2);
    const Table fine
      = solve("beam_and_reference",
              scene("loads/beam_on_elastic_foundation.prm"),
              tight
                + "--set 'Adaptivity/Strategy=none' --set 'Mesh/Volume bound=0.05' --set "
                  "'Reference/Type=fine mesh' --set Reference/Size=0.25 --set "
                  "'Estimation/Estimators=spr, energy, ren, degree extrapolation'");
    within("degree extrapolation by the difference to a reference",
           fine.last("estimate_degree_extrapolation") / fine.last("estimate"),
           0.8,
           1.2);
  }

  void
  ranks()
  {
    std::vector<Table> tables;
    for (const std::string n : {"1", "2", "3"})
      tables.push_back(solve("ranks_" + n,
                             scene("verification/manufactured_on_springs_p2.prm"),
                             tight + "--set 'Adaptivity/Maximum cycles=2' --set Solver/Type=cg "
                               + all_estimators(),
                             "mpirun --allow-run-as-root --oversubscribe -n " + n));
    for (const std::string &name : estimators)
      for (unsigned int t = 1; t < 3; ++t)
        check("  " + name + " is the same on " + std::to_string(t + 1) + " ranks",
              near(tables[t].last("estimate_" + name),
                   tables[0].last("estimate_" + name),
                   name == "equilibrated" ? 0.03 : 1e-8));
    for (const std::string name : {"strain_energy", "spring_energy", "energy_error"})
      for (unsigned int t = 1; t < 3; ++t)
        check("  " + name + " is the same on " + std::to_string(t + 1) + " ranks",
              near(tables[t].last(name), tables[0].last(name), 1e-8));
  }

  /** What a run of one of the scenes says before it solves anything. */
  void
  messages(const std::string &what,
           const std::string &option,
           const std::string &file,
           const std::string &overrides)
  {
    const auto result = run(option + " --quiet --output-directory " + fresh("said").string() + " "
                            + overrides + " " + scene(file));
    std::cout << what << ": exit code " << result.code << '\n';
    // Places begin with a path.
    std::istringstream lines(result.err);
    for (std::string line; std::getline(lines, line);)
      {
        const auto path = line.find(".prm:");
        std::cout << "  " << (path == std::string::npos ? line : line.substr(path + 1)) << '\n';
      }
  }

  void
  refused()
  {
    const std::string beam     = "loads/beam_on_elastic_foundation.prm";
    const std::string validate = "--validate", preview = "--preview";
    messages("components", validate, beam, "--set Supports/foundation/Components=z");
    messages("no stiffness", validate, beam, "--set Supports/foundation/Stiffness=0");
    messages("negative", preview, beam, "--set 'Supports/foundation/Stiffness=x - 1'");
    messages("at a point",
             validate,
             beam,
             "--set 'Supports/foundation/Groups=' --set 'Supports/foundation/Point=0, 0, 0'");
    messages("stiffness of a fixed support", validate, beam, "--set Supports/side/Stiffness=3");
    messages("mixed form",
             validate,
             beam,
             "--set Formulation=mixed --set 'Materials/beam/Poisson ratio=0.3' --set "
             "Estimation/Estimators=spr");
    messages("hexahedra", validate, beam, "--set Reference/Type=hexahedra");
    messages("known energy", validate, beam, "--set 'Exact solution/Strain energy=1'");
    messages("not held",
             preview,
             beam,
             "--set Supports/side/Components=z --set 'Supports/side/Groups=x-min'");
    messages("a curved wall without projection",
             preview,
             "verification/cylinder_on_springs_p1.prm",
             "--set Mesh/Projection=none");
  }
} // namespace

int
main()
{
  for (const unsigned int degree : {1, 2})
    {
      manufactured(degree);
      cylinder(degree);
    }
  beam();
  ranks();
  refused();
}
