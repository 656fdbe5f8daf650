// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Forces at points and supports at points and on lines: exact solutions and totals in every cycle,
// convergence away from them, what errors leave out, and refusals.

#include "program.h"

#include <array>

using namespace program;

namespace
{
  /** What statics does not say. */
  const double unknown = std::nan("");

  /** The rows of reactions.csv of a support or load: six numbers of force and moment a cycle. */
  std::vector<std::array<double, 6>>
  resultants(const fs::path &folder, const std::string &name)
  {
    std::vector<std::array<double, 6>> result;
    std::ifstream                      file(folder / "reactions.csv");
    std::string                        line;
    while (std::getline(file, line))
      {
        std::vector<std::string> cells;
        std::istringstream       stream(line);
        std::string              cell;
        while (std::getline(stream, cell, ','))
          cells.push_back(cell);
        if (cells.size() < 14 || cells[2] != name)
          continue;
        result.emplace_back();
        for (unsigned int i = 0; i < 6; ++i)
          result.back()[i] = std::strtod(cells[8 + i].c_str(), nullptr);
      }
    return result;
  }

  void
  check_resultant(const fs::path              &folder,
                  const std::string           &name,
                  const std::array<double, 6> &right,
                  const double                 tolerance = 1e-9)
  {
    const auto found = resultants(folder, name);
    bool       all   = !found.empty();
    for (const auto &cycle : found)
      for (unsigned int i = 0; i < 6; ++i)
        all = all && (std::isnan(right[i]) || std::abs(cycle[i] - right[i]) <= tolerance);
    check("  " + name + ": force and moment", all);
    if (!all)
      for (const auto &cycle : found)
        {
          for (const double number : cycle)
            std::cout << ' ' << number;
          std::cout << std::endl;
        }
  }

  std::string
  scene_text(const std::string &mesh,
             const std::string &supports,
             const std::string &loads,
             const std::string &rest,
             const unsigned int degree = 1)
  {
    return "set Title = points\nset Degree = " + std::to_string(degree) + "\nsubsection Mesh\n"
           + mesh
           + "end\nsubsection Materials\n subsection m\n  set Young modulus = 1000\n  set Poisson "
             "ratio = 0.3\n end\nend\nsubsection Supports\n"
           + supports + "end\nsubsection Loads\n" + loads
           + "end\nsubsection Solver\n set Tolerance = 1e-12\nend\n" + rest;
  }

  std::string
  block(const std::string &name, const std::vector<std::string> &settings)
  {
    std::string text = " subsection " + name + "\n";
    for (const auto &setting : settings)
      text += "  set " + setting + "\n";
    return text + " end\n";
  }

  const std::string box = " set Type = box\n set Upper corner = 2, 1, .5\n set Size = .35\n";
  const std::string adaptive
    = "subsection Adaptivity\n set Strategy = adaptive\n set Refinement indicator = spr\n set "
      "Maximum cycles = 3\n";

  Result
  run_scene(const std::string &name, const std::string &text, const std::string &before = "")
  {
    write(name + ".prm", text);
    const auto result
      = run("--output-directory " + fresh(name).string() + " " + name + ".prm", before);
    if (result.code != 0)
      std::cout << name << ": code " << result.code << std::endl << result.err << std::endl;
    return result;
  }

  /** A force at a corner of bricks that is a vertex of every one of them. */
  void
  corner_of_bricks()
  {
    const auto result = run_scene(
      "corner",
      scene_text(" set Type = bricks\n set Upper corner = 4, 1, 1\n set Cells = 8x2x2\n",
                 block("base", {"Groups = x-min"}),
                 block("tip", {"Type = point force", "Point = 4, 0, 0", "Value = 0; 0; -1"}),
                 "subsection Estimation\n set Estimators = spr, residual\nend\n"));
    std::cout << "corner of bricks" << std::endl;
    check_resultant("corner", "tip", {{0., 0., -1., 0., 4., 0.}});
    check_resultant("corner", "base", {{0., 0., 1., 0., -4., 0.}});
    const std::string log = read("corner/log.txt");
    check("  said first", contains(log, "grows without limit as the mesh is refined"));
    check("  said last", contains(result.out, "does not converge at Loads/tip"));
    check("  the ball is said", contains(result.out, "within 0.2 of (4, 0, 0)"));
    check("  nothing is guaranteed", !contains(log + result.out, "guarantee"));
  }

  /** Three points hold a bar in balance: uniform stress, no reactions. */
  void
  three_points()
  {
    const std::string supports
      = block("a", {"Point = 0, 0, 0", "Excluded radius = 0"})
        + block("b", {"Point = 2, 0, 0", "Components = y, z", "Excluded radius = 0"})
        + block("c", {"Point = 0, .6, 0", "Components = z", "Excluded radius = 0"});
    const std::string loads = block("left", {"Groups = x-min", "Value = -2; 0; 0"})
                              + block("right", {"Groups = x-max", "Value = 2; 0; 0"});
    for (const unsigned int degree : {1, 2})
      {
        std::cout << "three points, degree " << degree << std::endl;
        const std::string name = "three" + std::to_string(degree);
        run_scene(name,
                  scene_text(box,
                             supports,
                             loads,
                             "subsection Exact solution\n set Displacement = x/500; -.3*y/500; "
                             "-.3*z/500\nend\nsubsection Estimation\n set Estimators = residual, "
                             "local degree extrapolation\nend\nsubsection Adaptivity\n set "
                             "Strategy = uniform\n set Maximum cycles = 2\nend\n",
                             degree));
        const Table table(name);
        bool        exact = table.n_rows() == 2;
        for (unsigned int row = 0; row < table.n_rows(); ++row)
          exact = exact && table.value("relative_energy_error", row) < 1e-9;
        check("  exact", exact);
        for (const char *support : {"a", "b", "c"})
          check_resultant(name, support, {{0., 0., 0., 0., 0., 0.}}, 1e-8);
      }
  }

  /** Two hinges carry what is between them: by statics, a part each. */
  void
  hinges()
  {
    const std::string supports
      = block("fixed", {"Line = .4, 0, .5 : .4, 1, .5"})
        + block("sliding", {"Line = 1.9, 0, 0 : 1.9, 1, 0", "Components = z"})
        + block("guide", {"Point = 1.2, .5, .25", "Components = y"});
    const std::string loads
      = block("top", {"Where = z > .5 - 1e-9 && x < 1.3", "Value = 0; 0; -3"});
    // 3.9 at x = .65: moments about x = .4 give 1.9's share.
    const double share = 3.9 * .25 / 1.5;
    for (const std::string way : {"refined", "from scratch", "cut into eight"})
      {
        const unsigned int degree = way == "refined" ? 2 : 1;
        std::cout << "hinges, " << way << std::endl;
        run_scene("hinges",
                  scene_text(box,
                             supports,
                             loads,
                             way == "cut into eight"
                               ? "subsection Adaptivity\n set Strategy = uniform\n set Maximum "
                                 "cycles = 2\nend\n"
                               : adaptive
                                   + (way == "refined" ? "end\n" : " set Coarsening = yes\nend\n"),
                             degree));
        check("  cycles", Table("hinges").n_rows() >= 2);
        check_resultant("hinges", "top", {{0., 0., -3.9, -1.95, 2.535, 0.}}, 1e-7);
        check_resultant("hinges", "sliding", {{0., 0., share, unknown, -1.9 * share, 0.}}, 1e-6);
      }
  }

  /** What is away from a point converges although the energy grows. */
  void
  convergence()
  {
    std::cout << "away from a point" << std::endl;
    const std::string text = scene_text(
      " set Type = box\n set Upper corner = 1, 1, .5\n set Size = .25\n",
      block("base", {"Groups = z-min"}),
      block(
        "finger",
        {"Type = point force", "Point = .5, .4, .5", "Value = 0; 0; -1", "Excluded radius = .15"}),
      "subsection Goals\n subsection far\n  set Type = point displacement\n  set Point = .9, .9, "
      ".5\n  set Component = z\n end\nend\n"
      "subsection Reference\n set Type = fine mesh\n set Size = max(.02, min(.08, "
      ".25*sqrt((x-.5)^2+(y-.4)^2+(z-.5)^2)))\n set Cache = no\nend\n"
      "subsection Estimation\n set Estimators = spr, residual\nend\n"
      "subsection Adaptivity\n set Strategy = adaptive\n set Refinement indicator = spr\n set "
      "Maximum cycles = 4\n set Growth = 4\nend\n");
    const auto  result = run_scene("far", text);
    const Table table("far");
    check("  four cycles", table.n_rows() == 4);
    check("  the difference to the reference falls",
          table.falls("relative_energy_error") && table.last("relative_energy_error") < .25);
    check("  the energy grows",
          table.value("strain_energy", 3) > 1.3 * table.value("strain_energy", 0));
    if (const double ratio
        = table.last("relative_estimate_spr") / table.last("relative_energy_error");
        ratio > .7 && ratio < 1.3)
      std::cout << "  spr is near it: yes" << std::endl;
    else
      std::cout << "  spr is near it: NO, " << ratio << std::endl;
    check("  answer", contains(result.out, "errors leave out"));
    check("  energies are not compared",
          contains(read("far/log.txt"),
                   "without comparing their energy: the energy of Loads/finger grows"));
  }

  /** What is said of places that are probably not meant so. */
  void
  warnings()
  {
    std::cout << "warnings" << std::endl;
    run_scene(
      "warned",
      scene_text(box,
                 block("base", {"Groups = x-min"})
                   + block("pin", {"Point = 2, .5, 0", "Excluded radius = 0"}),
                 block("top", {"Groups = z-max", "Value = 0; 0; -1"})
                   + block("lost", {"Type = point force", "Point = 0, .5, .5", "Value = 1; 0; 0"})
                   + block("deep",
                           {"Type = point force", "Point = 1, .5, .495", "Value = 0; 0; -1"}),
                 "subsection Goals\n subsection near\n  set Type = point displacement\n  "
                 "set Point = 1.05, .5, .5\n end\nend\n"));
    const std::string log = read("warned/log.txt");
    check("  a support carries something without a radius",
          contains(log, "Supports/pin has a reaction of"));
    check("  a support takes up a force",
          contains(log, "Loads/lost: all components of this force"));
    check("  a point just below the surface", contains(log, "lies inside the body, only 0.005"));
    check("  a goal in a ball", contains(log, "Goals/near/Point: it lies within 0.1 of"));
  }

  void
  refusals()
  {
    std::cout << "refused" << std::endl;
    const auto refuse = [](const std::string              &what,
                           const std::string              &supports,
                           const std::string              &loads,
                           const std::string              &rest,
                           const std::vector<std::string> &parts,
                           const std::string              &mesh = box) {
      write("refused.prm", scene_text(mesh, supports, loads, rest));
      // The size of a body is not known before it is meshed.
      const bool is_size = contains(what, "too large");
      for (const char *way : {"", "--validate "})
        {
          if (is_size && *way != 0)
            continue;
          const auto result = run(std::string(way) + "--output-directory "
                                  + fresh("refused").string() + " refused.prm");
          bool       all    = result.code == 2;
          for (const auto &part : parts)
            all = all && contains(result.err, part);
          check("  " + what + (*way == 0 ? "" : ", validated"), all);
          if (!all)
            std::cout << result.code << std::endl << result.err << std::endl;
        }
    };
    const std::string base = block("base", {"Groups = z-min"});
    const std::string force
      = block("tip", {"Type = point force", "Point = 1, .5, .5", "Value = 0; 0; -1"});
    refuse("a point and faces, a line and a point, a radius below 0",
           base + block("a", {"Point = 0, 0, 0", "Where = x < 1e-9"})
             + block("b", {"Point = 0, 0, 0", "Line = 0, 0, 0 : 1, 0, 0", "Excluded radius = -1"}),
           force,
           "",
           {"Supports/a/Where", "Supports/b/Line", "Supports/b/Excluded radius"});
    refuse("a force without a point, a traction with one",
           base,
           block("a", {"Type = point force", "Value = 0; 0; 1"})
             + block("b", {"Point = 1, 0, 0", "Where = x < 1e-9", "Value = 0; 0; 1"}),
           "",
           {"Loads/a/Point", "Loads/b/Point"});
    refuse("a force at a point on faces",
           base,
           block("a", {"Type = point force", "Point = 1, 0, 0", "Where = x < 1e-9"}),
           "",
           {"Loads/a/Where"});
    refuse(
      "a point outside",
      base,
      block("a", {"Type = point force", "Point = 1, .5, .75", "Value = 0; 0; 1"}),
      "",
      {"Loads/a/Point: (1, 0.5, 0.75) lies outside of the body, whose nearest point is (1, 0.5, "
       "0.5)"});
    refuse("a line that leaves the body",
           base + block("a", {"Line = 1, .5, .2 : 1, .5, .7"}),
           force,
           "",
           {"Supports/a/Line: it leaves the body at (1, 0.5, 0.5"});
    refuse("no vertex",
           base,
           block("a", {"Type = point force", "Point = 1, .5, .2", "Value = 0; 0; 1"}),
           "",
           {"The nearest one is", "at a distance of 0.2"},
           " set Type = bricks\n set Upper corner = 2, 1, 1\n set Cells = 4x2x1\n");
    refuse("estimators and the known energy",
           base,
           force,
           "subsection Estimation\n set Estimators = equilibrated, richardson, spr\nend\n"
           "subsection Exact solution\n set Strain energy = 1\nend\n",
           {"equilibrated is a bound", "richardson extrapolates", "Exact solution/Strain energy"});
    refuse("hexahedra",
           base,
           force,
           "subsection Reference\n set Type = hexahedra\nend\n",
           {"Reference/Type"});
    refuse(
      "too large a ball",
      base,
      block("tip",
            {"Type = point force", "Point = 1, .5, .5", "Value = 0; 0; -1", "Excluded radius = 5"}),
      "",
      {"Loads/tip/Excluded radius", "every tetrahedron"});
  }

  void
  ranks()
  {
    std::cout << "two ranks" << std::endl;
    const std::string text
      = scene_text(box,
                   block("a", {"Line = .4, 0, .5 : .4, 1, .5"}) + block("b", {"Groups = x-max"}),
                   block("f", {"Type = point force", "Point = 1, .5, .25", "Value = 1; 2; -1"}),
                   adaptive + "end\n");
    run_scene("one", text);
    run_scene("two", text, "mpirun --oversubscribe -np 2");
    check("  agree", Table("one").distance(Table("two")) < 1e-6);
  }
} // namespace

int
main()
{
  corner_of_bricks();
  three_points();
  hinges();
  convergence();
  warnings();
  refusals();
  ranks();
}
