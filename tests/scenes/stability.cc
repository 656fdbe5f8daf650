// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The scenes of prm/stability: in other units, far away, with bad cells, contrasts and few
// elements, results are right to the digits stated, or the program says what is wrong.

#include "program.h"

using namespace program;

namespace
{
  std::string
  stability(const std::string &name)
  {
    return "'" + scene("stability/" + name + ".prm") + "'";
  }

  Table
  table_of(const std::string &name, const std::string &options = "")
  {
    const std::string folder = "t" + std::to_string(std::hash<std::string>()(name + options));
    const auto        result
      = run("--quiet --output-directory " + folder + " " + options + " " + stability(name));
    if (result.code != 0)
      std::cout << name << " " << options << ": " << result.err << std::endl;
    return Table(folder);
  }

  /** The figures of two runs, after scaling displacements by @p length and energies by
   * @p energy. */
  bool
  equal(const Table &a, const Table &b, const double length, const double energy)
  {
    bool same = a.n_rows() == b.n_rows() && b.n_rows() > 0;
    for (const char *name : {"relative_estimate_spr",
                             "relative_estimate_averaging",
                             "relative_estimate_residual",
                             "relative_estimate_local_degree_extrapolation"})
      same = same && near(a.last(name), b.last(name), 1e-8);
    // Its local problems are solved in single precision.
    return same
           && near(a.last("relative_estimate_equilibrated"),
                   b.last("relative_estimate_equilibrated"),
                   1e-6)
           && near(a.last("max_displacement"), length * b.last("max_displacement"), 1e-8)
           && near(a.last("goal_tip"), length * b.last("goal_tip"), 1e-8)
           && near(a.last("strain_energy"), energy * b.last("strain_energy"), 1e-8);
  }

  void
  units_and_places()
  {
    for (const std::string options : {"--set Degree=1", "--set Degree=2 --set Solver/Type=direct"})
      {
        const Table plain = table_of("cantilever", options);
        std::cout << options << '\n';
        check("  1e-9 times as large", equal(table_of("nanometres", options), plain, 1e-9, 1e-27));
        check("  1e9 times as large", equal(table_of("gigametres", options), plain, 1e9, 1e27));
        check("  moved", equal(table_of("far_away", options), plain, 1., 1.));
        check("  tiny load", equal(table_of("tiny_load", options), plain, 1e-30, 1e-60));
      }
    const auto mixed
      = run("--output-directory mixed --set Degree=1 " + stability("millimetres_and_pascals"));
    check("units mixed: a warning about the displacement",
          mixed.code == 0 && contains(mixed.err, "linear theory is doubtful")
            && contains(mixed.err, "N, mm and MPa go together"));
  }

  /** TetGen's own tolerances do not depend on units: the first mesh is the same. */
  void
  meshes()
  {
    const std::string size = "--set Mesh/Type=box --set Degree=1 --set Solver/Type=direct ";
    const Table plain = table_of("cantilever", size + "--set Mesh/Size=0.4 --set Mesh/Cells=1x1x1");
    const Table far   = table_of("far_away", size + "--set Mesh/Size=0.4 --set Mesh/Cells=1x1x1");
    const Table nano  = table_of("nanometres", size + "--set Mesh/Size=4e-10");
    check("TetGen far away: the same mesh",
          far.last("tets") == plain.last("tets")
            && near(far.last("strain_energy"), plain.last("strain_energy"), 1e-8));
    check("TetGen in nanometres: the energy within 3 %",
          near(1e27 * nano.last("strain_energy"), plain.last("strain_energy"), 0.03));
  }

  void
  bad_cells()
  {
    for (const std::string name : {"slivers", "needles", "size_ratio"})
      for (const std::string options :
           {"--set Degree=1", "--set Degree=2", "--set Degree=2 --set Solver/Type=direct"})
        if (name != "size_ratio" || !contains(options, "direct"))
          // Conjugate gradients end by the residual: 1.3e-7 or 3.4e-7 with other compilers.
          check(name + " " + options, table_of(name, options).last("relative_energy_error") < 1e-6);
    // A residual of 1e-8 used to leave an error of 1e-3 on cells of 0.0004 degrees.
    write("flat.node", "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 .3 .3 1e-5\n");
    write("flat.ele", "4 4 0\n0 0 1 2 4\n1 0 1 4 3\n2 1 2 4 3\n3 2 0 4 3\n");
    const auto flat = run("--output-directory flat --set Mesh/Files="
                          + fs::absolute("flat.node").string() + " " + stability("slivers"));
    check("cells of less than a thousandth of a degree: right, and warned of",
          flat.code == 0 && Table("flat").last("relative_energy_error") < 1e-4
            && contains(flat.err, "nearly flat"));
  }

  void
  contrasts()
  {
    for (const std::string options :
         {"--set Degree=1", "--set Degree=2", "--set Degree=2 --set Solver/Type=direct"})
      check("contrast " + options,
            near(table_of("contrast", options).last("strain_energy"), 0.000500000005, 1e-9));
    const std::string modulus = "--quiet --set 'Materials/stiff/Young modulus=";
    const auto        high = run(modulus + "1e14' --output-directory c " + stability("contrast"));
    check("contrast of 1e11: warned of",
          high.code == 0 && contains(high.err, "rounding in the stiff part"));
    const auto too_high = run(modulus + "1e16' --output-directory c " + stability("contrast"));
    check("contrast of 1e13: refused",
          too_high.code == 2 && contains(too_high.err, "Materials/stiff/Young modulus"));
    for (const std::string options : {"--set Solver/Type=cg", "--set Solver/Type=direct"})
      check("loads of a million to one " + options,
            near(table_of("load_range", options).last("goal_side"), 1e-9, 1e-8));
    const double direct = table_of("held_by_a_corner", "--set Degree=1 --set Solver/Type=direct")
                            .last("strain_energy");
    check("held by a corner: both solvers the same",
          near(table_of("held_by_a_corner", "--set Degree=1").last("strain_energy"), direct, 1e-9));
  }

  /** Poisson ratios up to 0.5 in mixed form: a known energy, bad cells and other units. */
  void
  incompressible()
  {
    for (const std::string nu : {"1e-3", "0.49999", "0.5"})
      for (const std::string solver : {"cg", "direct"})
        check("incompressible, " + nu + ", " + solver,
              near(table_of("incompressible",
                            "--set 'Materials/bar/Poisson ratio=" + nu
                              + "' --set Solver/Type=" + solver)
                     .last("strain_energy"),
                   0.001,
                   1e-8));
    const std::string mixed
      = "--set Formulation=mixed --set 'Estimation/Estimators=spr, averaging, residual' --set "
        "'Materials/beam/Poisson ratio=0.5'";
    const Table plain = table_of("cantilever", mixed), nano = table_of("nanometres", mixed);
    bool        same = plain.n_rows() > 0;
    for (const char *name :
         {"relative_estimate_spr", "relative_estimate_averaging", "relative_estimate_residual"})
      same = same && near(nano.last(name), plain.last(name), 1e-6);
    check("incompressible, 1e-9 times as large",
          same && near(1e27 * nano.last("strain_energy"), plain.last("strain_energy"), 1e-8)
            && near(1e9 * nano.last("goal_tip"), plain.last("goal_tip"), 1e-8));
  }

  void
  limits()
  {
    const std::string mixed
      = " --set Degree=2 --set Formulation=mixed --set "
        "Estimation/Estimators=spr --set 'Adaptivity/Refinement indicator=spr'";
    for (const std::string &form : {std::string(" --set Degree=1"), mixed})
      for (const std::string load : {"1e150", "1e-150", "1e-300", "1e300"})
        for (const std::string solver : {"cg", "direct"})
          {
            const auto result = run("--quiet" + form + " --set 'Loads/tip/Value=0; 0; " + load
                                    + "' --set Solver/Type=" + solver + " --output-directory l "
                                    + stability("cantilever"));
            check("a load of " + load + ", " + solver + (form == mixed ? ", mixed" : "")
                    + ": refused",
                  result.code == 1
                    && (contains(result.err, "units") || contains(result.err, "are not finite")));
          }
    const auto modulus
      = run("--quiet --set 'Materials/beam/Young modulus=1e-60' --output-directory l "
            + stability("cantilever"));
    check("a modulus of 1e-60: refused",
          modulus.code == 2 && contains(modulus.err, "Materials/beam/Young modulus"));
    const auto both = run("--quiet --set 'Supports/clamp/Displacement=0; 0; 0.1' --set "
                          "Estimation/Estimators=richardson --validate "
                          + stability("cantilever"));
    check("Richardson with loads and moved supports: refused while the scene is read",
          both.code == 2 && contains(both.err, "Estimation/Estimators"));
  }

  /** Meshes of one, two and five tetrahedra, refined by all ways. */
  void
  few_elements()
  {
    write("1.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    write("1.ele", "1 4 0\n0 0 1 2 3\n");
    write("2.node", "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1\n");
    write("2.ele", "2 4 0\n0 0 1 2 3\n1 1 4 2 3\n");
    write("5.node",
          "8 3 0 0\n0 0 0 0\n1 0 0 1\n2 0 1 0\n3 0 1 1\n4 1 0 0\n5 1 0 1\n6 1 1 0\n7 1 1 1\n");
    write("5.ele", "5 4 0\n0 0 4 2 1\n1 3 2 7 1\n2 5 7 4 1\n3 6 4 7 2\n4 1 4 7 2\n");
    for (const std::string number : {"1", "2", "5"})
      {
        write("few.prm", R"(
set Degree = 2
subsection Mesh
  set Type  = file
  set Files = )" + number + R"(.node
end
subsection Materials
  subsection m
    set Young modulus = 10
  end
end
subsection Supports
  subsection b
    set Where = z < 1e-9
  end
end
subsection Loads
  subsection l
    set Where = x < 1e-9
    set Value = 1; 0; 0.5
  end
end
subsection Estimation
  set Estimators = degree extrapolation, local degree extrapolation, richardson, averaging, spr, residual, interpolation, equilibrated
end
subsection Adaptivity
  set Maximum cycles = 3
end
)");
        bool fine = true;
        for (const std::string options :
             {"--set Adaptivity/Strategy=adaptive --set 'Adaptivity/Refinement indicator=spr'",
              "--set Adaptivity/Strategy=uniform --set Solver/Type=cg"})
          {
            const auto  result = run("--quiet --output-directory few " + options + " few.prm");
            const Table table("few");
            bool        rises = table.n_rows() > 1;
            for (unsigned int row = 1; row < table.n_rows(); ++row)
              rises = rises
                      && table.value("strain_energy", row) > table.value("strain_energy", row - 1);
            fine = fine && result.code == 0 && rises;
          }
        check(number + " tetrahedra: refined, the energy rises", fine);
      }
  }
} // namespace

int
main()
{
  units_and_places();
  meshes();
  bad_cells();
  contrasts();
  incompressible();
  limits();
  few_elements();
}
