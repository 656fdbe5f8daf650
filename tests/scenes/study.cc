// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A study of 2 x 2 runs, two of which fail: folders, tables, plots, exit codes; the same on
// two ranks and without gnuplot; and input errors, which stop it before anything runs.

#include "program.h"

using namespace program;

namespace
{
  std::string
  beam(const std::string &study)
  {
    return R"(set Title = Study's beam
subsection Mesh
  set Upper corner = 2, 1, 1
end
subsection Materials
  subsection tissue
    set Young modulus = 1000
  end
end
subsection Supports
  subsection clamp
    set Groups = x-min
  end
end
subsection Loads
  subsection tip
    set Groups = x-max
    set Value = 0; 0; -1
  end
end
subsection Exact solution
  set Strain energy = 0.05
end
subsection Adaptivity
  set Strategy = uniform
  set Maximum cycles = 2
end
subsection Output
  set VTU = no
  set Plots = yes
end
subsection Study
)" + study + "end\n";
  }

  const std::string two_by_two = R"(
  subsection degree
    set Parameters = Degree
    set Values = 1 | 2
    set Labels = P1 | P2, quadratic
  end
  subsection time
    set Parameters = TetGen/Time limit & Solver/Type
    set Values = 600 & direct | 1e-6 & cg
  end
)";

  /** The first cells of every row: what varies, and the cycle. */
  void
  print_start(const std::string &csv)
  {
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);)
      {
        std::size_t end    = 0;
        bool        quoted = false;
        for (unsigned int commas = 0; end < line.size() && commas < 7; ++end)
          {
            quoted = quoted != (line[end] == '"');
            commas += line[end] == ',' && !quoted;
          }
        std::cout << "  " << line.substr(0, end) << '\n';
      }
  }

  void
  refused(const std::string &what, const std::string &study)
  {
    write("wrong.prm", beam(study));
    const auto result
      = run("--set Mesh/Type=bricks --set Mesh/Cells=2x1x1 --output-directory wrong wrong.prm");
    std::cout << what << ": code " << result.code << ", ran " << fs::exists("wrong") << ", "
              << portable(result.err);
  }
} // namespace

int
main()
{
  write("study.prm", beam(two_by_two));
  auto result = run("--validate study.prm");
  check("valid", result.code == 0 && contains(result.err, "a study of 4 runs"));
  check("nothing is run", !fs::exists("output"));

  result = run("--output-directory s study.prm");
  std::cout << "exit code " << result.code << '\n' << portable(result.err);
  std::cout << files("s") << '\n' << files("s/01-P1-time-600-direct") << '\n';
  check("plots of the study and of each run",
        fs::exists("s/plots/convergence_dofs.gp")
          && fs::exists("s/01-P1-time-600-direct/plots/convergence_seconds.gp"));
  const std::string csv = read("s/study.csv");
  print_start(csv);
  check("outcomes",
        contains(read("s/study.txt"), "failed") && contains(read("s/study.txt"), "done"));
  check("the terminal tells the runs apart",
        contains(result.out, "Run 3 of 4: P2, quadratic, time 600 direct"));
  const Table one("s/01-P1-time-600-direct"), three("s/03-P2-quadratic-time-600-direct");
  check("P2 is softer than P1",
        three.value("strain_energy", 0) > 1.5 * one.value("strain_energy", 0));
  const std::string parameters = read("s/03-P2-quadratic-time-600-direct/parameters.prm");
  check("a run's parameters are those of a scene of its own",
        contains(parameters, "Degree      = 2") && !contains(parameters, "P2, quadratic |"));
  result = run("--quiet --output-directory again s/03-P2-quadratic-time-600-direct/parameters.prm");
  check("which gives the same", result.code == 0 && Table("again").distance(three) < 1e-12);

  result = run("--quiet --output-directory s2 --set 'Study/time/Values=600 & direct' study.prm",
               "mpirun -np 2");
  check("two ranks, one case less: all done", result.code == 0);
  check("the same figures",
        Table("s2/01-P1-time-600-direct").distance(one) < 1e-9
          && Table("s2/02-P2-quadratic-time-600-direct").distance(three) < 1e-9);

  result = run("--quiet --output-directory s3 --set 'Study/time/Values=600 & direct' study.prm",
               "PATH=/nowhere");
  check("without gnuplot: scripts, and a word about it",
        result.code == 0 && contains(result.err, "gnuplot is missing")
          && fs::exists("s3/plots/convergence_dofs.gp")
          && !fs::exists("s3/plots/convergence_dofs.svg"));

  write("s3/01-P1-time-600-direct/notes.txt", "mine");
  run("--quiet --output-directory s3 --set 'Study/time/Values=600 & cg' study.prm");
  check("runs that the study had before are gone, other files stay",
        !fs::exists("s3/02-P2-quadratic-time-600-direct")
          && fs::exists("s3/01-P1-time-600-direct/notes.txt")
          && !fs::exists("s3/01-P1-time-600-direct/log.txt")
          && fs::exists("s3/02-P2-quadratic-time-600-cg"));

  refused("unknown parameter",
          "subsection a\nset Parameters = Solver/Tolerence\nset Values = 1\nend\n");
  refused("value that does not fit",
          "subsection a\nset Parameters = Degree\nset Values = 1 | two\nend\n");
  refused("value that makes no sense",
          "subsection a\nset Parameters = Materials/tissue/Poisson ratio\nset Values = 0.3 | "
          "0.7\nend\n");
  refused("a mesh that has nothing to hold",
          "subsection a\nset Parameters = Supports/clamp/Groups\nset Values = x-min | left\nend\n");
}
