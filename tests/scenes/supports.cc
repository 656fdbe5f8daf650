// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The scenes of prm/supports against their exact solutions, and what scenes with sliding or rigid
// supports may not ask for.

#include "program.h"

using namespace program;

namespace
{
  std::string
  supports(const std::string &name)
  {
    return "'" + scene("supports/" + name + ".prm") + "'";
  }

  /** What run() gives, with a table of the cycles in @p folder. */
  Result
  run_scene(const std::string &name, const std::string &folder, const std::string &options = "")
  {
    const Result result
      = run("--quiet --output-directory " + folder + " " + options + " " + supports(name));
    if (result.code != 0)
      std::cout << name << " " << options << ": " << result.err << std::endl;
    return result;
  }

  /** A figure of results.csv: its computed value. */
  double
  result_of(const std::string &folder, const std::string &name)
  {
    std::istringstream lines(read(folder + "/results.csv"));
    std::string        line, cell;
    while (std::getline(lines, line))
      if (line.compare(0, name.size() + 1, name + ",") == 0)
        {
          std::istringstream cells(line);
          for (unsigned int c = 0; c < 3; ++c)
            std::getline(cells, cell, ',');
          return std::stod(cell);
        }
    return std::nan("");
  }

  void
  exact_solutions()
  {
    for (const std::string degree : {"1", "2"})
      {
        run_scene("inclined_block", "block", "--set Solver/Tolerance=1e-12 --set Degree=" + degree);
        check("inclined block, degree " + degree + ": exact",
              Table("block").last("relative_energy_error") < 1e-10);
      }
    run_scene("rigid_end", "end", "--set Solver/Tolerance=1e-12");
    check("rigid end: exact", Table("end").last("relative_energy_error") < 1e-9);
    check("its rotation", near(result_of("end", "support plate rotation y"), 0.096, 1e-8));
    check("its translation", near(result_of("end", "support plate translation z"), -0.192, 1e-8));

    run_scene("tube_sector",
              "tube",
              "--set 'Estimation/Estimators=spr, averaging, residual, interpolation, degree "
              "extrapolation, local degree extrapolation, exact'");
    const Table tube("tube");
    check("tube: the tolerance is reached", tube.last("relative_energy_error") <= 0.02);
    for (const char *name : {"spr",
                             "averaging",
                             "residual",
                             "interpolation",
                             "degree_extrapolation",
                             "local_degree_extrapolation"})
      {
        const double ratio = tube.last(std::string("relative_estimate_") + name)
                             / tube.last("relative_energy_error");
        check(std::string("tube: ") + name + " within a half and twice of the error",
              ratio > 0.5 && ratio < 2.);
      }
    run_scene("inclined_block",
              "uneven",
              "--set 'Loads/pressure/Value=2 + x^3' --set 'Exact solution/Displacement=' --set "
              "'Exact solution/Strain energy=0' --set 'Estimation/Estimators=energy, degree "
              "extrapolation' --set 'Reference/Type=fine mesh' --set Reference/Size=0.25 --set "
              "Reference/Cache=no");
    const Table uneven("uneven");
    check("uneven pressure: a reference that slides also",
          near(uneven.last("relative_energy_error"),
               uneven.last("relative_estimate_degree_extrapolation"),
               0.1));

    run_scene("sliding_ball", "ball");
    const Table ball("ball");
    check("ball: the wall does not hold it tight",
          ball.n_rows() > 1 && ball.last("relative_energy_error") <= 0.25);

    run_scene("shaft", "shaft");
    // The mesh lacks a part of the area.
    check("shaft: turns by M L / (G J)",
          std::abs(result_of("shaft", "support flange rotation z") / 0.0318309886 - 1.) < 0.03);
  }

  std::string
  message_of(const Result &result)
  {
    std::string text = result.err;
    if (const auto at = text.find("Error: "); at != std::string::npos)
      text = text.substr(at);
    const std::string root = fs::path(SOURCE_DIR).parent_path().parent_path().string() + "/";
    for (auto at = text.find(root); at != std::string::npos; at = text.find(root))
      text.erase(at, root.size());
    return text;
  }

  /** A round bar that slides in a round hole is free to turn, but for the unevenness of its
   * faces; less of the wall holds it. */
  void
  loose_wall()
  {
    const std::string meshes
      = (fs::path(SOURCE_DIR).parent_path().parent_path() / "meshes").string();
    const auto run_with = [&](const std::string &wall, const std::string &mesh) {
      write("loose.prm",
            "set Degree = 1\n"
            "subsection Mesh\n set Type = file\n set Files = "
              + meshes + "/shaft.msh\n" + mesh
              + "end\nsubsection Materials\n subsection stuff\n  set Young modulus = 1\n end\nend\n"
                "subsection Supports\n subsection hole\n  set Type = sliding\n  set Groups = side\n"
              + wall
              + " end\n subsection end\n  set Groups = z-min\n  set Components = z\n end\nend\n"
                "subsection Loads\n subsection top\n  set Groups = z-max\n  set Value = x; y; 1\n"
                " end\nend\n");
      return run("--quiet --output-directory loose loose.prm");
    };
    const std::string projected
      = " set Projection = expression\n set Projection functions = x^2 + y^2 - 1\n";
    Result result = run_with("", "");
    std::cout << "round bar in a hole of facets -> " << result.code << '\n'
              << message_of(result) << std::endl;
    result = run_with("", projected);
    std::cout << "round bar in a round hole -> " << result.code << '\n'
              << message_of(result) << std::endl;
  }

  void
  refusals()
  {
    const std::vector<std::pair<std::string, std::string>> wrong{
      {"inclined_block", "Estimation/Estimators=equilibrated"},
      {"inclined_block", "Formulation=mixed"},
      {"inclined_block", "Supports/sides/Components=x"},
      {"inclined_block", "Supports/sides/Force=1;0;0"},
      {"inclined_block", "Supports/sides/Normal displacement=t"},
      {"inclined_block", "Supports/sides/Type=slides"},
      {"inclined_block", "Mesh/Feature angle=0"},
      {"rigid_end", "Reference/Type=hexahedra"},
      {"rigid_end", "Estimation/Estimators=degree extrapolation"},
      {"rigid_end", "Estimation/Estimators=local degree extrapolation"},
      {"rigid_end", "Estimation/Estimators=goal"},
      {"rigid_end", "Estimation/Estimators=equilibrated"},
      {"rigid_end", "Solver/Multigrid=trilinos"},
      {"rigid_end", "Supports/plate/Translation=0, 0, 0"},
      {"rigid_end", "Supports/plate/Rotation=0, free"},
      {"rigid_end", "Supports/plate/Moment=x; 0; 0"},
      {"rigid_end", "Supports/plate/Normal displacement=1"},
      {"rigid_end", "Supports/wall/Groups=z-min"},
      {"rigid_end", "Supports/wall/Type=rigid"}};
    for (const auto &[name, setting] : wrong)
      {
        const Result result
          = run("--quiet --output-directory wrong --set '" + setting + "' " + supports(name));
        std::cout << setting << " -> " << result.code << '\n' << message_of(result) << std::endl;
      }
  }
} // namespace

int
main()
{
  exact_solutions();
  loose_wall();
  refusals();
}
