// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Loads, supports and goals that are not where the user thinks: refused or told, and shown by
// --preview.

#include "program.h"

using namespace program;

namespace
{
  /** A bar 2 x 1 x 1 that stands on x = 0. */
  std::string
  bar(const std::string &load,
      const std::string &support = "set Where = x < 1e-9",
      const std::string &more    = "",
      const std::string &mesh
      = "set Type = bricks\n set Upper corner = 2, 1, 1\n set Cells = 8x4x4")
  {
    return "subsection Mesh\n " + mesh
           + "\nend\nsubsection Materials\n subsection m\n  set Young modulus = 1000\n  set "
             "Density = "
             "2\n end\nend\nsubsection Supports\n subsection foot\n  "
           + support + "\n end\nend\nsubsection Loads\n subsection tip\n  " + load + "\n end\nend\n"
           + more;
  }

  Result
  tell(const std::string &what, const std::string &text, const std::string &options = "--quiet")
  {
    fresh("out");
    write("s.prm", text);
    const auto result = run(options + " --output-directory out s.prm");
    std::cout << what << ": exit code " << result.code << '\n'
              << portable(result.err) << std::flush;
    return result;
  }

  void
  held_loads()
  {
    const std::string force = "\n  set Value = 0; 0; -1";
    tell("load on a support", bar("set Groups = x-min" + force));
    tell("load on half a support",
         bar("set Groups = z-max" + force,
             "set Where = x < 1e-9 || (z > 1-1e-9 && x < 0.5 + 1e-9)"));
    tell("load beside a support", bar("set Groups = x-max" + force));
  }

  void
  goals()
  {
    const auto goal = [](const std::string &point) {
      return bar("set Groups = x-max\n  set Value = 0; 0; -1",
                 "set Where = x < 1e-9",
                 "subsection Goals\n subsection g\n  set Component = z\n  set Point = " + point
                   + "\n end\nend\n");
    };
    tell("goal on the surface", goal("2, 0.5, 1"));
    tell("goal outside", goal("2.01, 0.5, 1"));
    tell("goal far outside", goal("1, 3, 1.5"));
    check("  no results", !fs::exists("out/convergence.csv"));
  }

  /** The second mesh has no face where the load is. */
  void
  later_mesh()
  {
    const std::string load = "set Where = x > 1.9\n  set Value = 0; 0; -1";
    write("long.prm", bar(load));
    run("--quiet --output-directory long long.prm");
    write("short.prm",
          bar("set Groups = x-max\n  set Value = 0; 0; -1",
              "set Groups = x-min",
              "",
              "set Type = bricks\n set Upper corner = 1.5, 1, 1\n set Cells = 6x4x4"));
    run("--quiet --output-directory short short.prm");
    const auto text = bar(load,
                          "set Groups = x-min",
                          "subsection Adaptivity\n set Strategy = mesh list\nend\n",
                          "set Type = file\n set Files = long/cycle_000.vtu; short/cycle_000.vtu");
    tell("nothing found in the second mesh", text);
    check("  the first cycle is there", Table("out").n_rows() == 1);
    tell("validated", text, "--quiet --validate");
  }

  /** What is known without a mesh. */
  void
  names()
  {
    const std::string more
      = "subsection Goals\n subsection g\n  set Type = mean displacement\n  set "
        "Boundary ids = 7\n end\nend\n";
    const auto text = [&](const std::string &mesh) {
      return bar(
        "set Groups = x-mux\n  set Value = 0; 0; -1\n end\n subsection weight\n  set Type = "
        "body force\n  set Regions = 3\n  set Value = 0; 0; -1",
        "set Where = x < sqrt(1 - x) - 2",
        more,
        mesh);
    };
    tell("names of a box", text("set Type = box"), "--quiet --validate");
    tell("names of blocks",
         text("set Type = blocks\n set Blocks = 0,0,0 : 1,1,1; 1,0,0 : 3,1,1"),
         "--quiet --validate");
    tell("names of bricks", text("set Type = bricks"), "--quiet --validate");
    tell("nowhere on a box",
         bar("set Groups = x-max\n  set Value = 0; 0; -1",
             "set Where = x < -0.5",
             "",
             "set Type = box"),
         "--quiet --validate");
  }

  void
  preview()
  {
    write(
      "p.prm",
      bar("set Where = x > 2-1e-9\n  set Value = 0; 0; -1\n end\n subsection weight\n  set Type = "
          "gravity\n  set Value = 0; 0; -9.81"));
    const auto shown = run("--preview --output-directory seen p.prm");
    std::cout << "preview: exit code " << shown.code << '\n' << portable(shown.out) << std::flush;
    std::cout << "  written: " << files("seen") << std::endl;
    check("  nothing was solved", !contains(shown.err, "ycle") && !contains(shown.out, "ycle"));
    const auto box = run("--preview --quiet --set 'Mesh/Type=box' --output-directory box p.prm");
    check("  of a box, quietly", box.code == 0 && box.out.empty() && fs::exists("box/preview.vtu"));
    const auto parallel
      = run("--preview --output-directory two p.prm", "mpirun --oversubscribe -np 2");
    check("  the same on two ranks",
          parallel.code == 0 && read("two/preview.vtu") == read("seen/preview.vtu"));
    write(
      "study.prm",
      read("p.prm")
        + "subsection Study\n subsection a\n  set Parameters = Mesh/Cells\n  set Values = 4x2x2 | "
          "6x3x3\n end\nend\n");
    const auto study = run("--preview --output-directory study study.prm");
    check("  of a study the first scene",
          study.code == 0 && contains(study.out, "Loads/tip") && files("study") == "preview.vtu");
    const auto loose = run("--preview --quiet --set 'Supports/foot/Where=x < -1' p.prm");
    check("  nothing found is an error", loose.code == 2 && contains(loose.err, "p.prm:13"));
    const auto free = run("--preview --quiet --set 'Supports/foot/Components=x' --output-directory "
                          "free p.prm");
    check("  a body that is free is an error", free.code == 2);
    // The file is on the list like every other that the program writes.
    const std::string again = "--preview --quiet --output-directory seen p.prm";
    check("  on the list", contains(read("seen/.tetradapt-files"), "preview.vtu"));
    check("  replaced by the next", run(again).code == 0);
    write("seen/preview.vtu", "changed");
    const auto changed = run(again);
    check("  not replaced once it was changed",
          changed.code == 2 && contains(changed.err, "changed since")
            && read("seen/preview.vtu") == "changed");
    fs::create_directory("mine");
    write("mine/preview.vtu", "mine");
    for (const std::string what : {"--preview ", ""})
      {
        const auto foreign = run(what + "--quiet --output-directory mine p.prm");
        check(std::string("  somebody else's is refused by a ")
                + (what.empty() ? "run" : "preview"),
              foreign.code == 2 && contains(foreign.err, "mine/preview.vtu")
                && read("mine/preview.vtu") == "mine" && !fs::exists("mine/convergence.csv"));
      }
  }
} // namespace

int
main()
{
  held_loads();
  goals();
  later_mesh();
  names();
  preview();
}
