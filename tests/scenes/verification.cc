// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Scenes with known answers come out right: the values of the literature, and errors
// that fall as theory says. Meshes are kept small by overrides.

#include "program.h"

using namespace program;

namespace
{
  Table
  solve(const std::string &name, const std::string &overrides)
  {
    const fs::path folder = fresh(name);
    const auto     result = run("--quiet --output-directory " + name + " --set Output/VTU=no "
                            + overrides + " " + scene("verification/" + name + ".prm"));
    // Warnings tell sizes of meshes, which rounding may change.
    std::cout << name << ": exit code " << result.code << '\n'
              << (result.code == 0 ? "" : result.err);
    return Table(folder);
  }

  void
  within(const std::string &what, const double value, const double lower, const double upper)
  {
    std::cout << "  " << what << " from " << lower << " to " << upper << ": ";
    if (value >= lower && value <= upper)
      std::cout << "yes" << std::endl;
    else
      std::cout << "NO, " << value << std::endl;
  }

  /** The exponent s in error ~ N^-s, from row @p first to the last. */
  double
  rate(const Table &table, const unsigned int first)
  {
    const unsigned int last = table.n_rows() - 1;
    return std::log(table.value("relative_energy_error", first)
                    / table.value("relative_energy_error", last))
           / std::log(table.value("dofs", last) / table.value("dofs", first));
  }

  void
  l_shape()
  {
    const Table adaptive = solve("l_shape_p1", "--set 'Adaptivity/Maximum tetrahedra=20000'");
    check("  error falls in every cycle", adaptive.falls("relative_energy_error"));
    // N^-1/3, within a tenth.
    within("rate", rate(adaptive, 3), 0.30, 0.37);
    within("effectivity of spr", adaptive.last("effectivity_spr"), 0.8, 1.1);
    const Table uniform = solve("l_shape_p1_uniform", "--set 'Adaptivity/Maximum cycles=4'");
    // N^-0.1815 in the end; coarse meshes fall a little faster.
    within("rate", rate(uniform, 2), 0.16, 0.23);
    const Table quadratic = solve("l_shape_p2", "--set 'Adaptivity/Maximum tetrahedra=5000'");
    within("rate", rate(quadratic, 2), 0.45, 0.60);
  }

  void
  sphere()
  {
    const Table linear = solve("lame_sphere_p1", "--set 'Adaptivity/Maximum tetrahedra=20000'");
    check("  error falls in every cycle", linear.falls("relative_energy_error"));
    within("rate", rate(linear, 2), 0.28, 0.37);
    const Table quadratic = solve("lame_sphere_p2", "--set 'Adaptivity/Maximum tetrahedra=5000'");
    within("relative energy error", quadratic.last("relative_energy_error"), 0.005, 0.03);
    const Table mixed
      = solve("lame_sphere_nu5_mixed",
              "--set Adaptivity/Strategy=uniform --set 'Adaptivity/Maximum cycles=3'");
    // As in displacement form with nu = 0.3; N^-2/3.
    within("relative energy error", mixed.last("relative_energy_error"), 0.030, 0.033);
    within("rate", rate(mixed, 1), 0.6, 0.8);
    within("iterations", mixed.last("iterations"), 15, 35);
  }

  void
  goals()
  {
    const std::string some = " --set 'Adaptivity/Maximum cycles=3'";
    const Table       face = solve("manufactured_goals", "--set 'Estimation/Goal=face'" + some);
    within("effectivity of a face's mean, P1", face.last("goal_face_effectivity"), 0.9, 1.1);
    const Table ball
      = solve("manufactured_goals", "--set 'Estimation/Goal=ball' --set Degree=2" + some);
    within("effectivity of a point's stress, P2", ball.last("goal_ball_effectivity"), 0.9, 1.1);
  }

  void
  panels()
  {
    const Table cook = solve("cook_membrane_p2", "--set 'Adaptivity/Maximum tetrahedra=4000'");
    within("u_y at (48, 52)", cook.last("goal_mid-point"), 23.9, 24.02);
    const Table membrane = solve("nafems_le1_p2", "--set 'Adaptivity/Maximum tetrahedra=10000'");
    within("s_yy at D", membrane.last("goal_stress_at_D"), 90., 95.);
  }
} // namespace

int
main()
{
  l_shape();
  sphere();
  goals();
  panels();
}
