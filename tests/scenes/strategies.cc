// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Every way of marking, sizing and stopping, on the beam of the quickstart.

#include "program.h"

using namespace program;

namespace
{
  std::vector<std::string> names;

  /** A scene that includes the quickstart and sets more in Adaptivity, and in
   * other sections. */
  void
  add(const std::string &name, const std::string &adaptivity, const std::string &others = "")
  {
    names.push_back(name);
    write(name + ".prm",
          "include " + scene("quickstart.prm")
            + "\nsubsection Reference\n set Size = 0.15\n set Cache directory = kept\nend\n"
              "subsection Output\n set VTU = no\nend\n"
              "subsection Adaptivity\n"
            + adaptivity + "end\n" + others);
  }

  void
  run_all()
  {
    std::string list;
    for (const auto &name : names)
      list += " " + name + ".prm";
    const auto result = run("--quiet --output-directory " + fresh("all").string() + list);
    std::cout << names.size() << " scenes: exit code " << result.code << std::endl;
  }

  std::string
  last_words(const std::string &name)
  {
    const std::string log = read("all/" + name + "/log.txt");
    for (const std::string words : {"Tolerance reached",
                                    "Stopped without convergence: the reference",
                                    "Stopped without convergence: this mesh",
                                    "Stopped without convergence: TetGen",
                                    "Stopped without convergence: the wanted",
                                    "Stopped at a limit",
                                    "Done: the scene asks for one mesh",
                                    "Done: all 3 meshes",
                                    "Done: 4 cycles"})
      if (contains(log, words))
        return words;
    return "NOTHING KNOWN";
  }

  void
  markings()
  {
    names.clear();
    for (const std::string marking : {"optimal size", "maximum", "fixed fraction", "doerfler"})
      for (const std::string control : {"node sizes", "volume constraints"})
        for (const std::string indicator : {"energy", "ren"})
          add(marking.substr(0, 3) + "_" + control.substr(0, 4) + "_" + indicator,
              " set Marking = " + marking + "\n set Size control = " + control
                + "\n set Refinement indicator = " + indicator + "\n set Maximum cycles = 4\n");
    run_all();
    for (const auto &name : names)
      {
        const Table table("all/" + name);
        check(name + ": energy error falls in 4 cycles",
              table.n_rows() == 4 && table.falls("relative_energy_error"));
      }
  }

  void
  stops()
  {
    names.clear();
    add("cycles", " set Maximum cycles = 4\n");
    add("tetrahedra", " set Maximum tetrahedra = 200\n");
    add("unknowns", " set Maximum unknowns = 300\n");
    add("seconds", " set Maximum seconds = 1e-6\n");
    add("tolerance", " set Tolerance = 0.7\n");
    add("ren_tolerance", " set REN tolerance = 0.4\n");
    add("one", " set Strategy = none\n");
    add("finest", " set Minimum size = 5\n");
    add("cap", "", "subsection TetGen\n set Steiner points = 0\nend\n");
    add("uniform", " set Strategy = uniform\n set Maximum cycles = 4\n");
    const std::string bricks = "subsection Mesh\n set Type = bricks\n set Cells = ";
    add("list", " set Strategy = mesh list\n", bricks + "2x1x1, 4x1x1, 8x2x2\nend\n");
    const std::string same
      = bricks + "8x2x2\nend\nsubsection Reference\n set Mesh = bricks\n set Cells = ";
    add("saturated", " set Strategy = uniform\n", same + "8x2x2\n set Degree = 1\nend\n");
    add("finer", " set Strategy = uniform\n", same + "4x2x2\n set Degree = 1\nend\n");
    run_all();
    for (const auto &name : names)
      {
        const Table table("all/" + name);
        std::cout << name << ": " << last_words(name) << std::endl;
        const unsigned int n = table.n_rows();
        // Predictions keep to the limit, TetGen nearly.
        if (name == "tetrahedra")
          check("  hardly more than allowed",
                n > 1 && table.value("tets", n - 2) < 200 && table.last("tets") < 240);
        if (name == "unknowns")
          check("  not before",
                n > 1 && table.value("dofs", n - 2) < 300 && table.last("dofs") >= 300);
        if (name == "tolerance")
          check("  not before",
                table.n_rows() > 1 && table.value("relative_energy_error", n - 2) > 0.7
                  && table.last("relative_energy_error") <= 0.7);
        if (name == "ren_tolerance")
          check("  not before",
                table.n_rows() > 1 && table.value("mean_ren", n - 2) > 0.4
                  && table.last("mean_ren") <= 0.4);
        if (name == "uniform")
          check("  eight for one", table.value("tets", 3) == 512. * table.value("tets", 0));
      }
  }
} // namespace

int
main()
{
  fresh("kept");
  markings();
  stops();
}
