// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Large deformation through the whole program: a beam on meshes that get finer, a twisted block of
// two laws on one and two ranks, small loads against linear theory, and everything that is
// refused, by name.

#include "program.h"

using namespace program;

namespace
{
  const std::string beam = R"(
set Degree = 2
set Formulation = finite strain
subsection Mesh
  set Type         = bricks
  set Upper corner = 10, 1, 1
  set Cells        = 10x1x1
end
subsection Materials
  subsection m
    set Law = neo-Hookean
    set Young modulus = 1000
  end
end
subsection Supports
  subsection wall
    set Groups = x-min
  end
end
subsection Loads
  subsection tip
    set Groups = x-max
    set Value  = 0; 0; -0.75
  end
end
subsection Goals
  subsection tip
    set Type      = mean displacement
    set Groups    = x-max
    set Component = z
  end
end
subsection Output
  set VTU = no
end
)";

  void
  refined()
  {
    const fs::path folder = fresh("bent");
    const auto     result
      = run("--quiet --output-directory bent '" + scene("large_deformation/bent_cantilever.prm")
            + "' --set Output/VTU=no");
    std::cout << "bent cantilever: exit code " << result.code << '\n' << result.err;
    const Table table(folder);
    std::cout << "  tip " << table.word("goal_tip", 0) << ", " << table.word("goal_tip", 1) << ", "
              << table.word("goal_tip", 2) << '\n';
    check("  converges",
          std::abs(table.last("goal_tip") + 2.7698) < 0.005
            && std::abs(table.value("goal_tip", 1) + 2.7698) < 0.015);
    // A body of better meshes gives way more.
    check("  energy rises",
          table.value("strain_energy", 0) < table.value("strain_energy", 1)
            && table.value("strain_energy", 1) < table.value("strain_energy", 2));
  }

  void
  small_loads()
  {
    // With a millionth of the load, the theories agree to the next order.
    const std::string small     = "--set 'Loads/tip/Value=0; 0; -1e-6'";
    const Table       nonlinear = table_of("small", beam, small);
    const Table       linear
      = table_of("linear",
                 beam,
                 small + " --set Formulation=displacement --set 'Materials/m/Law=linear elastic'");
    for (const std::string column : {"goal_tip", "strain_energy", "max_displacement"})
      check("small loads, " + column, near(nonlinear.last(column), linear.last(column), 1e-5));
    // And St. Venant-Kirchhoff's law has the same tangent at rest.
    const Table other
      = table_of("other", beam, small + " --set 'Materials/m/Law=St. Venant-Kirchhoff'");
    check("small loads, another law", near(other.last("goal_tip"), linear.last("goal_tip"), 1e-5));
  }

  void
  twisted()
  {
    const std::string file = "'" + scene("large_deformation/twisted_block.prm") + "'";
    const fs::path    one = fresh("one"), two = fresh("two");
    const auto        result = run("--quiet --output-directory one --set Output/VTU=no " + file);
    std::cout << "twisted block: exit code " << result.code << '\n' << result.err;
    run("--quiet --output-directory two --set Output/VTU=no " + file, "mpirun -np 2");
    const Table a(one), b(two);
    check("  same on two ranks", a.n_rows() == 1 && a.distance(b) < 1e-6);
    check("  there is energy", a.last("strain_energy") > 0.05);
    check("  Newton's method", contains(read(one / "log.txt"), "Newton's method, "));
    const std::string reactions = read(one / "reactions.csv");
    check("  a table of reactions", contains(reactions, "upper end"));
  }

  void
  refuse(const std::string &what, const std::string &text, const std::string &options = "")
  {
    write("refused.prm", text);
    const auto result = run("--validate " + options + " refused.prm");
    std::cout << what << ": exit code " << result.code << '\n' << result.err;
  }

  std::string
  replaced(std::string text, const std::string &what, const std::string &by)
  {
    const auto at = text.find(what);
    return at == std::string::npos ? "" : text.replace(at, what.size(), by);
  }
} // namespace

int
main()
{
  refined();
  small_loads();
  twisted();

  refuse("law for small strains", beam, "--set 'Materials/m/Law=linear elastic'");
  refuse("law for finite strain", beam, "--set Formulation=displacement");
  refuse("mixed form", beam, "--set Formulation=mixed");
  refuse("constant of another law", beam, "--set 'Materials/m/Bulk modulus=3'");
  refuse("bad constant", beam, "--set 'Materials/m/Poisson ratio=0.5'");
  refuse("no such law", beam, "--set 'Materials/m/Law=neohookean'");
  refuse("pressure",
         replaced(beam, "set Value  = 0; 0; -0.75", "set Type = pressure\n    set Value = 1"));
  refuse("moment",
         replaced(beam,
                  "set Value  = 0; 0; -0.75",
                  "set Type = total force\n    set Value = 0; 0; -1\n    set Moment = 1; 0; 0"));
  refuse("estimators", beam, "--set 'Estimation/Estimators=spr, equilibrated, residual'");
  refuse("adaptivity", beam, "--set Adaptivity/Strategy=adaptive");
  refuse("reference", beam, "--set 'Reference/Type=fine mesh' --set Reference/Size=0.5");
  refuse("exact solution", beam, "--set 'Exact solution/Strain energy=1'");
  refuse("goal of stresses",
         replaced(beam,
                  "mean displacement\n    set Groups    = x-max\n    set Component = z",
                  "mean stress\n    set Component = xx"));
  // A material that must be turned inside out.
  write("crushed.prm", beam);
  const auto result
    = run("--quiet --output-directory crushed crushed.prm --set 'Loads/tip/Value=0; 0; -1e6'");
  std::cout << "too much: exit code " << result.code << ", says how far "
            << contains(result.err, "The body is in equilibrium up to") << ", results "
            << files("crushed") << '\n';
}
