// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a run says in the end, and its tables of reactions: whole, within 80 columns, the same on
// several ranks; warnings where the solver leaves too much.

#include "program.h"

using namespace program;

namespace
{
  /** A cantilever of 4 x 1 x 1 in two supports that meet, under its weight and a pressure. */
  void
  write_scene()
  {
    write("beam.prm",
          "set Title = beam\n"
          "subsection Mesh\n  set Type = bricks\n  set Upper corner = 4, 1, 1\n"
          "  set Cells = 8x2x2\nend\n"
          "subsection Materials\n  subsection steel\n    set Young modulus = 1000\n"
          "    set Density = 2\n  end\nend\n"
          "subsection Supports\n"
          "  subsection low\n    set Where = x < 1e-9 && z < 0.5 + 1e-9\n  end\n"
          "  subsection high\n    set Where = x < 1e-9 && z > 0.5 - 1e-9\n  end\nend\n"
          "subsection Loads\n"
          "  subsection weight\n    set Type = gravity\n    set Value = 0; 0; -0.5\n  end\n"
          "  subsection wind\n    set Type = pressure\n    set Where = y < 1e-9\n"
          "    set Value = 0.1*x\n  end\nend\n");
  }

  std::vector<std::string>
  lines(const std::string &text)
  {
    std::vector<std::string> result;
    std::istringstream       in(text);
    for (std::string line; std::getline(in, line);)
      result.push_back(line);
    return result;
  }

  std::vector<std::string>
  cells(const std::string &line)
  {
    std::vector<std::string> result;
    std::istringstream       in(line);
    for (std::string cell; std::getline(in, cell, ',');)
      result.push_back(cell);
    return result;
  }

  /** The numbers of the row of @p name in the last cycle of a reactions.csv, from force_x on. */
  std::vector<double>
  forces(const fs::path &folder, const std::string &name)
  {
    std::vector<double> result;
    for (const std::string &line : lines(read(folder / "reactions.csv")))
      if (const auto row = cells(line); row.size() > 13 && (row[2] == name || row[1] == name))
        {
          result.clear();
          for (unsigned int c = 8; c < row.size(); ++c)
            result.push_back(row[c].empty() ? 0. : std::stod(row[c]));
        }
    return result;
  }

  double
  distance(const std::vector<double> &a, const std::vector<double> &b, const unsigned int n)
  {
    double largest = a.size() < n || b.size() < n ? 1e300 : 0.;
    for (unsigned int i = 0; i < n && largest < 1e300; ++i)
      largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
  }

  std::vector<double>
  sum(const std::vector<double> &a, const std::vector<double> &b)
  {
    std::vector<double> result(6);
    for (unsigned int i = 0; i < 6 && i < a.size() && i < b.size(); ++i)
      result[i] = a[i] + b[i];
    return result;
  }

  void
  check_answer(const std::string &what, const Result &result)
  {
    const auto all  = lines(result.out);
    bool       fits = true, begun = false;
    for (const std::string &line : all)
      {
        begun = begun || line.find("Answer") == 0;
        fits  = fits && (!begun || line.size() <= 80);
      }
    check(what + ": ends with code 0", result.code == 0);
    check(what + ": an answer", begun);
    check(what + ": within 80 columns", fits);
    for (const std::string part : {"largest displacement",
                                   "largest von Mises",
                                   "reaction low",
                                   "load weight",
                                   "imbalance",
                                   "volume 4",
                                   "mass 8",
                                   "next"})
      check(what + ": " + part, contains(result.out, part));
  }
} // namespace

int
main()
{
  write_scene();
  const Result linear = run("beam.prm");
  check_answer("linear", linear);
  check("the answer comes last",
        lines(linear.out).back().find("  next") == 0
          || lines(linear.out).back().find("     ") == 0);
  check("log has it", contains(read("output/beam/log.txt"), "largest von Mises"));
  check("  and the names of all tables",
        contains(read("output/beam/log.txt"), "mesh.csv, reactions.csv, regions.csv"));
  check("results.txt has it", contains(read("output/beam/results.txt"), "low (support"));
  check("results.csv has it", contains(read("output/beam/results.csv"), "support low force x,"));
  // Weight 2 * 4 * 0.5 in (2, 1/2, 1/2); wind: int x/10 = 0.8 along y, moments int x z, int x^2.
  check("weight", distance(forces("output/beam", "weight"), {0, 0, -4, -2, 8, 0}, 6) < 1e-9);
  check("wind", distance(forces("output/beam", "wind"), {0, 0.8, 0, -0.4, 0, 6.4 / 3.}, 6) < 1e-9);
  const std::vector<double> all{0, -0.8, 4, 2.4, -8, -6.4 / 3.};
  check("reactions of both supports",
        distance(sum(forces("output/beam", "low"), forces("output/beam", "high")), all, 6) < 1e-6);

  run("--set Degree=2 --set Solver/Type=cg beam.prm --output-directory two");
  const std::string mpi = "mpirun --allow-run-as-root --oversubscribe -n 3";
  check("on three ranks",
        run("--set Degree=2 --set Solver/Type=cg beam.prm --output-directory three", mpi).code
          == 0);
  for (const std::string name : {"low", "high", "weight", "wind"})
    check("the same on three ranks: " + name,
          distance(forces("two", name), forces("three", name), 6) < 1e-6);
  check("the same regions",
        read("two/regions.csv").substr(0, 200).size() > 100
          && lines(read("two/regions.csv")).size() == lines(read("three/regions.csv")).size());

  check("quiet prints nothing", run("-q beam.prm").out.empty());
  const Result loose
    = run("--set Solver/Type=cg --set Solver/Tolerance=0.5 beam.prm --output-directory loose");
  check("a loose tolerance is warned of", contains(loose.err, "do not balance"));
  check("and the answer says so", contains(loose.out, "EXCEEDED"));
  const Result early
    = run("--set Degree=2 --set Solver/Type=cg --set Solver/Stopping=discretisation "
          "--set Adaptivity/Strategy=uniform --set Estimation/Estimators=spr --set "
          "'Adaptivity/Maximum cycles=2' "
          "beam.prm --output-directory early");
  const auto left = forces("early", "imbalance");
  check("stopped by the error: an imbalance that is allowed",
        early.code == 0 && left.size() >= 9 && left[7] <= left[8] && left[8] > 1e-8
          && !contains(early.err, "do not balance"));
}
