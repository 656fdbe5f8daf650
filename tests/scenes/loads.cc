// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Loads whose values peak and jump: the whole of them acts in every cycle, no mesh is rejected
// for a load that changed, bounds hold and say how far, and the meshes become fine there.

#include "program.h"

using namespace program;

namespace
{
  const double pi = std::acos(-1.);

  /** A block, 4 x 4 x 2, that stands on the ground. */
  std::string
  block(const std::string &load, const std::string &cycles)
  {
    return R"(
set Degree = 2
subsection Mesh
  set Type         = box
  set Lower corner = -2, -2, 0
  set Upper corner = 2, 2, 2
  set Volume bound = 0.05
end
subsection Materials
  subsection m
    set Young modulus     = 1
    set Poisson ratio     = 0.2
    set Thermal expansion = 0.01
  end
end
subsection Supports
  subsection ground
    set Groups = z-min
  end
end
subsection Loads
  subsection l
)" + load + R"(
  end
end
subsection Output
  set VTU   = no
  set Plots = no
end
subsection Adaptivity
  set Maximum cycles = )"
           + cycles + R"(
end
)";
  }

  /** A column of reactions.csv, of the load, one a cycle. */
  std::vector<double>
  of_load(const fs::path &folder, const std::string &column)
  {
    std::ifstream       file(folder / "reactions.csv");
    std::string         line, cell;
    std::vector<double> values;
    unsigned int        wanted = 0;
    for (bool heading = true; std::getline(file, line); heading = false)
      {
        std::vector<std::string> cells;
        std::istringstream       stream(line);
        while (std::getline(stream, cell, ','))
          cells.push_back(cell);
        if (heading)
          wanted = std::find(cells.begin(), cells.end(), column) - cells.begin();
        else if (cells.size() > 2 && cells[2] == "l")
          values.push_back(wanted < cells.size() ? std::atof(cells[wanted].c_str()) : std::nan(""));
      }
    return values;
  }

  bool
  all_near(const std::vector<double> &values, const double exact, const double tolerance)
  {
    return values.size() > 1 && std::all_of(values.begin(), values.end(), [&](const double value) {
             return std::abs(value - exact) <= tolerance * std::abs(exact);
           });
  }

  Result
  run_block(const std::string &name, const std::string &text, const std::string &options)
  {
    write(name + ".prm", text);
    fresh(name);
    const Result result = run("--output-directory " + name + " " + options + " " + name + ".prm");
    if (result.code != 0)
      std::cout << name << ": exit code " << result.code << '\n' << result.err;
    return result;
  }

  const std::string adaptive = "--set Adaptivity/Strategy=adaptive ";

  void
  patch()
  {
    run_block("patch",
              block("set Type = traction\nset Groups = z-max\n"
                    "set Value = 0; 0; if(abs(x - 0.31) < 0.23 && abs(y + 0.1) < 0.37, -2, 0)",
                    "6"),
              adaptive
                + "--set 'Adaptivity/Refinement indicator=spr' --set Estimation/Estimators=spr");
    check("the patch's force in every cycle",
          all_near(of_load("patch", "force_z"), -2. * .46 * .74, 1e-4));
    const Table table("patch");
    bool        accepted = table.n_rows() == 6;
    for (unsigned int row = 0; row < table.n_rows(); ++row)
      accepted = accepted && !(table.has("accepted") && table.value("accepted", row) == 0.);
    check("no mesh is rejected", accepted);
  }

  void
  peak()
  {
    const std::string text       = block("set Type = pressure\nset Groups = z-max\n"
                                         "set Value = exp(-400*((x + 0.153)^2 + (y - 0.287)^2))",
                                   "3");
    const std::string estimators = "--set 'Estimation/Estimators=residual, spr, equilibrated' ";
    const Result      coarse
      = run_block("coarse", text, estimators + "--set Adaptivity/Strategy=uniform");
    run_block("fine",
              text,
              adaptive
                + "--set 'Adaptivity/Refinement indicator=residual' --set 'Adaptivity/Maximum "
                  "cycles=9' --set 'Adaptivity/Maximum tetrahedra=30000' --set "
                  "Estimation/Estimators=residual");
    check("the peak's force in every cycle",
          all_near(of_load("coarse", "force_z"), -pi / 400., 1e-6)
            && all_near(of_load("fine", "force_z"), -pi / 400., 1e-6));
    // Energies rise to the exact one: what the fine mesh has more is part of the error.
    const Table  coarser("coarse"), finer("fine");
    const double best  = 2. * finer.last("strain_energy");
    bool         holds = coarser.n_rows() == 3;
    for (unsigned int row = 0; row < coarser.n_rows(); ++row)
      {
        const double error = std::sqrt(best - 2. * coarser.value("strain_energy", row));
        holds = holds && coarser.value("estimate_equilibrated", row) >= error && error > 0.;
        if (std::getenv("SHOW") != nullptr)
          std::cerr << "error " << error << " bound " << coarser.value("estimate_equilibrated", row)
                    << " spr " << coarser.value("estimate_spr", row) << " residual "
                    << coarser.value("estimate_residual", row) << '\n';
      }
    check("the bound holds", holds);
    check("it is guaranteed", contains(coarse.out, "guaranteed bound by 'equilibrated'"));
    for (const std::string indicator : {"spr", "energy"})
      {
        run_block(indicator,
                  text,
                  adaptive + "--set 'Adaptivity/Refinement indicator=" + indicator
                    + "' --set 'Adaptivity/Maximum cycles=" + (indicator == "energy" ? "2" : "5")
                    + "' --set 'Adaptivity/Maximum "
                      "tetrahedra=20000' --set Estimation/Estimators=equilibrated"
                    + (indicator == "energy" ? " --set 'Reference/Type=fine mesh' --set "
                                               "'Reference/Size=min(0.4, 0.02 + "
                                               "0.4*sqrt((x+0.153)^2+(y-0.287)^2+(z-2)^2))' --set "
                                               "Reference/Cache=no"
                                             : ""));
        const Table table(indicator);
        check("bound of meshes driven by " + indicator + " falls",
              table.last("estimate_equilibrated") < 0.5 * table.value("estimate_equilibrated", 0));
      }
  }

  void
  small_peak()
  {
    run_block("small",
              block("set Type = pressure\nset Groups = z-max\nset Smallest feature = 0.005\n"
                    "set Value = 1000*exp(-50000*((x + 0.153)^2 + (y - 0.287)^2))",
                    "2"),
              "--set Adaptivity/Strategy=uniform");
    check("a small peak, looked for",
          all_near(of_load("small", "force_z"), -1000. * pi / 50000., 1e-6));
  }

  void
  slab()
  {
    const Result result
      = run_block("slab",
                  block("set Type = body force\nset Value = 0; 0; if(x + 0.3*y < 0.21, -1, 0)",
                        "2"),
                  "--set Adaptivity/Strategy=uniform --set Estimation/Estimators=equilibrated");
    // The mean over y of the length in x, times the area across.
    check("a slab's weight", all_near(of_load("slab", "force_z"), -2.21 * 8., 1e-3));
    check("the bound is not called guaranteed",
          contains(result.out, "bound, up to the load's resolution,")
            && !contains(result.out, "guaranteed"));
    check("the remainder is said", contains(result.out, "load l is integrated to about"));
  }

  void
  projected()
  {
    const Result result
      = run("--output-directory sphere --set 'Adaptivity/Maximum cycles=2' --set Output/VTU=no "
            "--set Output/Plots=no "
            + scene("verification/lame_sphere_p1.prm"));
    check("the drift of a pressure on a sphere is said",
          result.code == 0 && contains(result.out, "since the first mesh"));
  }

  /** A polynomial of which nothing but rounding is left fits nowhere. */
  void
  rounding()
  {
    const Result result = run_block("rounding",
                                    block("set Type = pressure\nset Groups = z-max\nset Value = "
                                          "(x+1000)*(x+1000) - x^2 - 2000*x - 1000000",
                                          "1"),
                                    "");
    check("a value that is mere rounding is warned of",
          result.code == 0 && contains(result.err, "Loads/l is integrated to"));
  }

  void
  refused()
  {
    write("refused.prm",
          block("set Groups = z-max\nset Value = 0; 0; 1\nset Smallest feature = -1", "1"));
    const Result result = run("--validate refused.prm");
    check("refused: a negative size",
          result.code == 2 && contains(result.err, "Loads/l/Smallest feature"));
  }
} // namespace

int
main()
{
  patch();
  peak();
  small_peak();
  slab();
  projected();
  rounding();
  refused();
}
