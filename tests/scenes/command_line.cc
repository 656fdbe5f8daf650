// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the program does with its arguments and where it fails: exit codes, other
// scenes, files left behind, stages left out.

#include "program.h"

using namespace program;

namespace
{
  std::string
  block(const std::string &cells = "2x2x2")
  {
    return bricks_section(cells) + loaded_block("0; 0; -1");
  }

  void
  one_line(const std::string &what, const Result &result)
  {
    std::cout << what << ": exit code " << result.code << std::endl;
    std::istringstream lines(portable(result.err));
    for (std::string line; std::getline(lines, line);)
      std::cout << "  " << line << std::endl;
  }

  bool
  ends_with(const std::string &text, const std::string &end)
  {
    return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
  }

  void
  options()
  {
    const auto help = run("--help");
    check("help", help.code == 0 && contains(help.out, "--validate") && help.err.empty());
    const auto version = run("--version");
    for (const std::string library : {"tetradapt", "deal.II", "Trilinos", "TetGen", "CGAL"})
      check("version of " + library, version.code == 0 && contains(version.out, library));
    one_line("unknown option", run("--validat s.prm"));
    one_line("no scene", run("--quiet"));
    one_line("no such scene", run("nothing.prm"));
    one_line("unknown parameter", run("--set Solver/Tolerence=1 s.prm"));
    one_line("unknown subsection", run("--set Slover/Tolerance=1 s.prm"));
    one_line("output folder is a file", run("--quiet --output-directory s.prm s.prm"));

    fresh("output");
    const auto valid = run("--validate s.prm");
    check("validated", valid.code == 0 && contains(valid.err, "s.prm: valid"));
    check("  with both lists", contains(valid.err, "needs") && contains(valid.err, "skips"));
    const auto faces = run("--validate --quiet --set Loads/l/Groups=nix s.prm");
    check("  with the mesh's faces", faces.code == 2 && contains(faces.err, "the group 'nix'"));
    check("  nothing was run", valid.out.empty() && !fs::exists("output"));
    write("bad.prm", "set Degree = 3\n");
    const auto mixed = run("--validate --quiet s.prm bad.prm");
    one_line("one of two is bad", mixed);

    const auto quiet = run("--quiet s.prm");
    check("quiet", quiet.code == 0 && quiet.out.empty() && quiet.err.empty());
    std::cout << "  " << files("output/s") << std::endl;
    const auto again = run("--quiet --output-directory again output/s/parameters.prm");
    check("the effective input is a scene with the same figures",
          again.code == 0 && Table("output/s").distance(Table("again")) < 1e-14);
    run("--quiet --output-directory twice --set 'Loads/l/Value=0; 0; -2' s.prm");
    check("a parameter set on the command line",
          std::abs(Table("twice").last("max_displacement") / Table("again").last("max_displacement")
                   - 2.)
            < 1e-9);
  }

  void
  skipping()
  {
    const std::string none
      = "--quiet --set Output/Tables=no --set Output/VTU=no --output-directory ",
      no_worker        = "TETRADAPT_TETGEN_WORKER=/nonexistent";
    const auto without = run(none + fresh("few").string() + " s.prm", no_worker);
    check("bricks without TetGen", without.code == 0);
    std::cout << "  " << files("few") << std::endl;
    write("t.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    write("t.ele", "1 4 0\n0 0 1 2 3\n");
    const std::string file = "--set Mesh/Type=file --set Mesh/Files=t.node --set Mesh/Cells=1x1x1 "
                             "--set Supports/s/Groups= --set 'Supports/s/Where=z < 1e-9' "
                             "--set Loads/l/Groups= --set 'Loads/l/Where=x < 1e-9' ";
    check("a volume mesh without TetGen", run(none + "few " + file + "s.prm", no_worker).code == 0);
    const auto box = run(none + "few --set Mesh/Type=box --set Mesh/Cells=1x1x1 s.prm", no_worker);
    check("a box not", box.code == 1 && contains(box.err, "/nonexistent"));
    fresh("output");
    run(none + "few s.prm");
    check("no cache without a reference", !fs::exists("output"));
  }

  void
  several()
  {
    write("bad.prm", block() + "subsection Mesh\n set Cels = 1x1x1\nend\n");
    write("fails.prm",
          block("8x8x8") + "subsection Solver\n set Type = cg\n set Maximum iterations = 1\nend\n");
    write("last.prm", block());
    one_line("not finite", run("--quiet --set 'Materials/m/Young modulus=1e-308' s.prm"));
    one_line("loads not finite",
             run("--quiet --set Solver/Type=cg --set 'Loads/l/Value=1e308; 1e308; 0' s.prm"));
    one_line("not in time",
             run("--quiet --set Mesh/Type=box --set Mesh/Cells=1x1x1 --set 'Mesh/Volume "
                 "bound=1e-7' --set 'TetGen/Time limit=0.05' s.prm"));
    fresh("all");
    const auto all = run("--quiet --output-directory all s.prm bad.prm fails.prm last.prm");
    std::cout << "four scenes: exit code " << all.code << std::endl;
    for (const std::string name : {"s", "bad", "fails", "last"})
      std::cout << "  " << name << ": " << files("all/" + name) << std::endl;
    check("  the last is as good as the first", Table("all/s").distance(Table("all/last")) == 0.);
    check("  each error is told",
          contains(all.err, "Cels") && contains(all.err, "Conjugate gradients did not converge"));
    check("  also in the log", contains(read("all/fails/log.txt"), "did not converge"));
    std::cout << "a failing one: exit code " << run("--quiet fails.prm last.prm").code << std::endl;
    const auto parallel
      = run("--quiet --output-directory all fails.prm last.prm bad.prm", "mpirun -np 2");
    std::cout << "with two ranks: exit code " << parallel.code << std::endl;
    const auto at = parallel.err.find("did not converge");
    check("  each error is told once",
          at != std::string::npos
            && parallel.err.find("did not converge", at + 1) == std::string::npos
            && contains(parallel.err, "Cels"));
    one_line("twice the same", run("--quiet s.prm s.prm"));
  }

  /** The second mesh of two is broken: the first one's results stay, whole. */
  void
  failure()
  {
    write("broken.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 nan\n");
    write("broken.ele", "1 4 0\n0 0 1 2 3\n");
    const auto result
      = run("--quiet --output-directory " + fresh("half").string()
            + " --set Mesh/Type=file --set 'Mesh/Files=t.node; broken.node' --set Mesh/Cells=1x1x1 "
              "--set 'Adaptivity/Strategy=mesh list' --set Supports/s/Groups= --set "
              "'Supports/s/Where=z < 1e-9' --set Loads/l/Groups= --set 'Loads/l/Where=x < 1e-9' "
              "s.prm");
    one_line("second mesh is broken", result);
    std::cout << "  " << files("half") << std::endl;
    check("  one row", Table("half").n_rows() == 1);
    check("  complete files",
          ends_with(read("half/convergence.csv"), "\n")
            && contains(read("half/cycle_000.vtu"), "</VTKFile>")
            && contains(read("half/s.pvd"), "</VTKFile>"));
    check("  the error is in the log", contains(read("half/log.txt"), "line 5: 'nan'"));
    // The next run does not mix with the leftovers.
    write("half/notes.txt", "the user's own");
    run("--quiet --output-directory half s.prm");
    std::cout << "  then: " << files("half") << std::endl;
  }
} // namespace

int
main()
{
  write("s.prm", block());
  options();
  skipping();
  several();
  failure();
}
