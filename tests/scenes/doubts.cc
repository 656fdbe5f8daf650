// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What error estimates cannot see is warned of, in every cycle and at the end: displacements,
// strains and rotations too large for linear theory, slender parts of too few linear elements.

#include "program.h"

using namespace program;

namespace
{
  /** A block, its length along x, with what its ends do. */
  std::string
  block(const std::string &size, const std::string &cells, const std::string &rest)
  {
    return "subsection Mesh\n  set Type = bricks\n  set Upper corner = " + size
           + "\n  set Cells = " + cells
           + "\nend\nsubsection Materials\n  subsection m\n    set Young modulus = 1000\n    set "
             "Poisson ratio = 0.3\n  end\nend\nsubsection Estimation\n  set Estimators = "
             "spr\nend\nsubsection Output\n  set VTU = no\nend\n"
           + rest;
  }

  std::string
  moved(const std::string &group, const std::string &displacement)
  {
    return "subsection Supports\n  subsection " + group + "\n    set Groups = " + group
           + "\n    set Displacement = " + displacement + "\n  end\nend\n";
  }

  std::string
  loaded(const std::string &value)
  {
    return "subsection Loads\n  subsection l\n    set Groups = x-max\n    set Value = " + value
           + "\n  end\nend\n";
  }

  unsigned int
  count(const std::string &text, const std::string &part)
  {
    unsigned int n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
  }

  const std::string nonlinear = "linear theory is doubtful", locking = "linear elements lock";

  /** How often a run of @p text warns of @p what. */
  unsigned int
  warnings(const std::string &what, const std::string &text, const std::string &options = "")
  {
    write("scene.prm", text);
    fresh("results");
    const auto result = run("--output-directory results " + options + " scene.prm");
    if (result.code != 0)
      std::cout << "exit code " << result.code << '\n' << result.err;
    return count(result.err, what);
  }

  void
  linearity()
  {
    const std::string held = moved("x-min", "0; 0; 0");
    const auto        bar = [](const std::string &rest) { return block("2, 1, 1", "4x2x2", rest); };
    std::cout << "linear theory: warnings" << std::endl;
    // In each cycle and at the end.
    std::cout
      << "  pulled by 12 %: " << warnings(nonlinear, bar(held + moved("x-max", "0.24; 0; 0")))
      << '\n'
      << "  in three cycles: "
      << warnings(nonlinear,
                  bar(held + moved("x-max", "0.24; 0; 0")),
                  "--set Adaptivity/Strategy=uniform --set 'Adaptivity/Maximum cycles=3'")
      << '\n'
      << "  pulled by 5 %: " << warnings(nonlinear, bar(held + moved("x-max", "0.1; 0; 0"))) << '\n'
      << "  moved five times its length: "
      << warnings(nonlinear, bar(moved("x-min", "10; 0; 0") + moved("x-max", "10; 0; 0"))) << '\n'
      << "  turned by 20 degrees: "
      << warnings(nonlinear,
                  bar(moved("x-min", "-0.36*y; 0.36*x; 0") + moved("x-max", "-0.36*y; 0.36*x; 0")))
      << '\n'
      << "  turned by 2 degrees: "
      << warnings(nonlinear,
                  bar(moved("x-min", "-0.036*y; 0.036*x; 0")
                      + moved("x-max", "-0.036*y; 0.036*x; 0")))
      << '\n'
      << "  too large a load: " << warnings(nonlinear, bar(held + loaded("0; 0; -60"))) << '\n'
      << "  a small load: " << warnings(nonlinear, bar(held + loaded("0; 0; -0.5"))) << std::endl;
  }

  void
  thickness()
  {
    const std::string held = moved("x-min", "0; 0; 0");
    std::cout << "locking: warnings" << std::endl;
    const auto plate = [&](const std::string &cells, const std::string &value) {
      return block("10, 10, 0.5", cells, held + loaded(value));
    };
    std::cout << "  a plate of one linear element that bends: "
              << warnings(locking, plate("12x12x1", "0; 0; -0.001")) << '\n'
              << "  of three: " << warnings(locking, plate("10x10x3", "0; 0; -0.001")) << '\n'
              << "  of four: " << warnings(locking, plate("10x10x4", "0; 0; -0.001")) << '\n'
              << "  of one quadratic element: "
              << warnings(locking, plate("6x6x1", "0; 0; -0.001"), "--set Degree=2") << '\n'
              << "  that is stretched: " << warnings(locking, plate("12x12x1", "1; 0; 0")) << '\n'
              << "  a coarse cube that is sheared: "
              << warnings(locking, block("1, 1, 1", "2x2x2", held + loaded("0; 0; -1"))) << '\n'
              << "  a bar that twists: "
              << warnings(locking,
                          block("10, 1, 1",
                                "10x2x2",
                                held + moved("x-max", "0; -0.01*(z-0.5); 0.01*(y-0.5)")))
              << '\n'
              << "  TetGen's mesh of a thin plate: "
              << warnings(locking,
                          plate("1x1x1", "0; 0; -0.001"),
                          "--set Mesh/Type=box --set 'Mesh/Volume bound=0.1'")
              << std::endl;
  }
} // namespace

int
main()
{
  linearity();
  thickness();
}
