// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Kinds of scenes, each with a known answer: meshes of named groups and regions,
// heat, weight, pressure, a known solution, and the ways to a reference.

#include "program.h"

#include <array>

using namespace program;

namespace
{
  /** A bar 2 x 1 x 1 of n x n x n bricks as .msh 2.2: the regions "soft" (x < 1) and
   * "hard", and the boundary group "end" at x = 2. */
  void
  write_bar(const std::string &file, const unsigned int n)
  {
    std::ostringstream points, elements;
    const auto         number = [n](unsigned int i, unsigned int j, unsigned int k) {
      return 1 + i + (n + 1) * (j + (n + 1) * k);
    };
    for (unsigned int k = 0; k <= n; ++k)
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          points << number(i, j, k) << ' ' << 2. * i / n << ' ' << 1. * j / n << ' ' << 1. * k / n
                 << '\n';
    const unsigned int orders[6][3]
      = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    unsigned int count = 0;
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          for (const auto &order : orders)
            {
              std::array<unsigned int, 3> at{{i, j, k}};
              elements << ++count << " 4 2 " << (2 * i < n ? "11 1" : "12 2");
              elements << ' ' << number(at[0], at[1], at[2]);
              for (const unsigned int axis : order)
                {
                  ++at[axis];
                  elements << ' ' << number(at[0], at[1], at[2]);
                }
              elements << '\n';
            }
    // Both triangles of each square at x = 2, cut as the bricks are.
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (const unsigned int up : {0, 1})
          elements << ++count << " 2 2 21 3 " << number(n, j, k) << ' '
                   << number(n, j + 1 - up, k + up) << ' ' << number(n, j + 1, k + 1) << '\n';
    write(file,
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n3 11 \"soft\"\n3 12 "
          "\"hard\"\n2 21 \"end\"\n$EndPhysicalNames\n$Nodes\n"
            + std::to_string((n + 1) * (n + 1) * (n + 1)) + "\n" + points.str()
            + "$EndNodes\n$Elements\n" + std::to_string(count) + "\n" + elements.str()
            + "$EndElements\n");
  }

  const std::string rollers = R"(
subsection Supports
  subsection a
    set Where = x < 1e-9
    set Components = x
  end
  subsection b
    set Where = y < 1e-9
    set Components = y
  end
  subsection c
    set Where = z < 1e-9
    set Components = z
  end
end
)";

  Table
  go(const std::string &name, const std::string &text, const std::string &options = "")
  {
    write(name + ".prm", text);
    const auto result = run("--quiet --output-directory " + fresh(name).string() + " " + options
                            + " " + name + ".prm");
    std::cout << name << ": exit code " << result.code << '\n'
              << portable(result.err) << std::flush;
    return Table(name);
  }

  void
  exact(const std::string &what, const double value, const double exact, const double tolerance)
  {
    const bool good = std::abs(value - exact) <= tolerance * std::abs(exact);
    std::cout << "  " << what << ": ";
    if (good)
      std::cout << "exact" << std::endl;
    else
      std::cout << "WRONG, " << value << " instead of " << exact << std::endl;
  }

  void
  two_materials()
  {
    write_bar("bar.msh", 4);
    // nu/E is the same in both, so that they contract alike: strains 0.01 and 0.02.
    const auto table = go("two_materials",
                          "subsection Mesh\n set Type = file\n set Files = bar.msh\nend\n"
                          "subsection Materials\n subsection hard one\n set Region groups = hard\n "
                          "set Young modulus = 500\n"
                          " set Poisson ratio = 0.15\n end\n subsection soft one\n set Regions = "
                          "11\n set Young modulus = 1000\n"
                          " set Poisson ratio = 0.3\n end\nend\n"
                            + rollers
                            + "subsection Loads\n subsection pull\n set Groups = end\n set Value = "
                              "10; 0; 0\n end\nend\n",
                          "--set Degree=2");
    exact("strain energy", table.last("strain_energy"), 0.5 * 10. * 0.03, 1e-7);
    exact("largest displacement", table.last("max_displacement"), std::sqrt(9e-4 + 2 * 9e-6), 1e-7);
    check("  regions are in the .vtu", contains(read("two_materials/cycle_000.vtu"), "egion"));
  }

  const std::string cube = R"(
subsection Materials
  subsection m
    set Young modulus     = 1000
    set Poisson ratio     = 0.25
    set Density           = 3
    set Thermal expansion = 1e-3
  end
end
)";

  void
  loads()
  {
    const auto heat = go(
      "heat",
      cube + rollers
        + "subsection Loads\n subsection T\n set Type = temperature\n set Value = 20\n end\nend\n");
    exact("largest displacement", heat.last("max_displacement"), 0.02 * std::sqrt(3.), 1e-9);
    check("  no strain energy", std::abs(heat.last("strain_energy")) < 1e-12);

    const auto pressure = go("pressure",
                             cube + rollers
                               + "subsection Loads\n subsection p\n set Type = pressure\n set "
                                 "Groups = x-max, y-max, z-max\n"
                                 " set Value = 50\n end\nend\n");
    // p (1 - 2 nu) / E = 0.025, and p/2 times the volume it takes.
    exact("largest displacement", pressure.last("max_displacement"), 0.025 * std::sqrt(3.), 1e-9);
    exact("strain energy", pressure.last("strain_energy"), 0.5 * 50. * 0.075, 1e-9);

    // Stress 3 * 2 * z along z, sections contract freely.
    const auto weight
      = go("weight",
           "set Degree = 2\n" + cube
             + "subsection Supports\n subsection top\n set Groups = z-max\n set Displacement = "
               "-0.25*6e-3*x*z; -0.25*6e-3*y*z; 3e-3*(z^2 - 1) + 0.25*3e-3*(x^2 + y^2)\n end\nend\n"
               "subsection Loads\n subsection g\n set Type = gravity\n set Value = 0; 0; -2\n "
               "end\nend\n");
    exact("strain energy", weight.last("strain_energy"), 36. / 2000. / 3., 1e-8);
    exact("largest displacement", weight.last("max_displacement"), 3e-3, 1e-8);
  }

  /** Degree 1 is a part of degree 2 on the same mesh: half the square of the energy norm of
   * their difference is the difference of their strain energies. */
  void
  known_strain_energy()
  {
    const std::string heated
      = "subsection heat\n set Type = temperature\n set Value = 50*x\n end\n";
    const std::string pulled = "subsection pull\n set Groups = x-max\n set Value = 1; 3; 0\n end\n";
    const auto        text   = [](const std::string &loads, const std::string &displacement) {
      return cube
             + "subsection Supports\n subsection foot\n set Where = x < 1e-9\n set Displacement = "
             + displacement + "\n end\nend\nsubsection Loads\n" + loads + "end\n";
    };
    const std::string fixed = "0; 0; 0", moved = "0; 0.1*y; 0";
    const std::map<std::string, std::pair<std::string, std::string>> cases{
      {"pulled", {pulled, fixed}},
      {"heated", {heated, fixed}},
      {"heated_and_moved", {heated, moved}},
      {"moved", {"", moved}},
      {"heated_and_pulled", {heated + pulled, fixed}}};
    for (const auto &[name, scene] : cases)
      {
        const auto fine = go(name + "_fine", text(scene.first, scene.second), "--set Degree=2");
        std::ostringstream energy;
        energy.precision(12);
        energy << fine.last("strain_energy");
        const auto known = go(name,
                              text(scene.first, scene.second),
                              "--set Estimation/Estimators=spr --set 'Exact solution/Strain energy="
                                + energy.str() + "'");
        if (name == "heated_and_pulled")
          {
            check("  cannot be told, and that is said",
                  std::isnan(known.last("relative_energy_error"))
                    && known.word("error_source", 0) == "estimate spr"
                    && contains(read(name + "/log.txt"), "does not give the error"));
            continue;
          }
        const auto measured = go(name + "_measured",
                                 text(scene.first, scene.second),
                                 "--set 'Reference/Type=earlier run' --set Reference/File=" + name
                                   + "_fine/cycle_000.vtu");
        check("  by the known energy, by the reference",
              known.word("error_source", 0) == "known energy"
                && measured.word("error_source", 0) == "reference");
        exact("energy error", known.last("energy_error"), measured.last("energy_error"), 1e-6);
      }
  }

  void
  exact_solution()
  {
    const std::string u = "y*z; x*z + 0.1*x^2; x*y";
    const std::string text
      = cube
        + "subsection Supports\n subsection all\n set Where = everywhere\n set Displacement = " + u
        + "\n end\nend\nsubsection Loads\n subsection f\n set Type = body force\n"
          " set Value = 0; -80; 0\n end\nend\nsubsection Exact solution\n set Displacement = "
        + u + "\nend\n";
    // mu = 400: 0.2 mu is the divergence of the stress.
    const auto quadratic = go("quadratic_exact", text, "--set Degree=2");
    check("  no error",
          quadratic.last("relative_energy_error") < 1e-7
            && quadratic.last("relative_l2_error") < 1e-7);
    const auto linear
      = go("linear_exact",
           text
             + "subsection Adaptivity\n set Strategy = adaptive\n set Refinement indicator = "
               "exact\n set Maximum cycles = 4\nend\n");
    // Prescribed values are interpolated again, so that a cycle may gain no energy error.
    check("  error falls",
          linear.n_rows() == 4 && linear.falls("relative_l2_error")
            && linear.last("relative_energy_error")
                 < 0.5 * linear.value("relative_energy_error", 0));
    const auto         tolerance = go("tolerance",
                              text
                                + "subsection Adaptivity\n set Strategy = uniform\n set Maximum "
                                          "cycles = 9\n set Tolerance = 0.1\nend\n");
    const unsigned int n         = tolerance.n_rows();
    check("  stops at the tolerance",
          n > 1 && tolerance.last("relative_energy_error") < 0.1
            && tolerance.value("relative_energy_error", n - 2) >= 0.1);
    check("  and says so", contains(read("tolerance/log.txt"), "tolerance"));
  }

  void
  references()
  {
    const std::string base
      = cube
        + "subsection Supports\n subsection s\n set Where = z < 1e-9\n end\nend\n"
          "subsection Loads\n subsection l\n set Where = z > 1-1e-9\n set Value = sin(3*x); 0; "
          "-1\n end\nend\n";
    const std::string mesh = "subsection Mesh\n set Type = bricks\n set Cells = ";
    go("fine", "set Degree = 2\n" + base + mesh + "6x6x6\nend\n");
    const std::string coarse = base + mesh + "3x3x3\nend\nsubsection Reference\n set Cache = no\n";
    const auto        bricks
      = go("by_bricks",
           coarse + " set Type = fine mesh\n set Mesh = bricks\n set Cells = 6x6x6\nend\n");
    const auto file
      = go("by_file",
           coarse
             + " set Type = fine mesh\n set Mesh = file\n set File = fine/cycle_000.vtu\nend\n");
    const auto run
      = go("by_run", coarse + " set Type = earlier run\n set File = fine/cycle_000.vtu\nend\n");
    check("  there is an error", bricks.last("relative_energy_error") > 0.1);
    check("  bricks and file: the same figures", bricks.distance(file) < 1e-6);
    // The loads of an earlier run are not known, so that the recovery of its error does
    // without them.
    check("  bricks and run: the same figures",
          bricks.distance(run, "reference_error_estimate") < 1e-6);
    check("  the reference's own error is told",
          bricks.last("reference_error_estimate") > 0.01
            && bricks.last("reference_error_estimate") < bricks.last("relative_energy_error")
            && contains(read("by_run/log.txt"), "relative energy error"));
    const auto other = go(
      "other_body",
      base + mesh
        + "3x3x3\n set Upper corner = 2, 1, 1\nend\n"
          "subsection Reference\n set Type = earlier run\n set File = fine/cycle_000.vtu\nend\n");
    check("  a row all the same", other.n_rows() == 1);
  }
} // namespace

int
main()
{
  two_materials();
  loads();
  known_strain_energy();
  exact_solution();
  references();
}
