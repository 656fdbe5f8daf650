// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Loads act on the part of the surface that the scene names, in every cycle: the integral
// of the stress zz over a body clamped at z = 0 is that of z times the traction, exactly.

#include "program.h"

using namespace program;

namespace
{
  std::string
  body(const std::string &mesh, const std::string &loads, const std::string &adaptivity)
  {
    return "set Title = selections\nset Degree = 1\n"
           "subsection Mesh\n"
           + mesh
           + "end\n"
             "subsection Materials\n subsection m\n  set Young modulus = 1000\n  set Poisson ratio "
             "= 0.3\n end\nend\n"
             "subsection Supports\n subsection base\n  set Where = z < 1e-9\n end\nend\n"
             "subsection Loads\n"
           + loads
           + "end\n"
             "subsection Goals\n subsection moment\n  set Type = functional\n  set Stress weight = "
             "0; 0; 1; 0; 0; 0\n end\nend\n"
             "subsection Reference\n set Type = none\nend\n"
             "subsection Solver\n set Tolerance = 1e-12\nend\n"
             "subsection Adaptivity\n"
           + adaptivity + "end\n";
  }

  std::string
  traction(const std::string &name, const std::string &where, const std::string &value)
  {
    return " subsection " + name + "\n  set Type = traction\n  set Where = " + where
           + "\n  set Value = 0; 0; " + value + "\n end\n";
  }

  void
  in_every_cycle(const std::string &name,
                 const std::string &scene_text,
                 const double       right,
                 const double       tolerance)
  {
    write(name + ".prm", scene_text);
    const auto result
      = run("--quiet --output-directory " + fresh(name).string() + " " + name + ".prm");
    const Table table(name);
    bool        all = result.code == 0 && table.n_rows() > 0;
    for (unsigned int row = 0; row < table.n_rows(); ++row)
      all = all && std::abs(table.value("goal_moment", row) - right) <= tolerance * std::abs(right);
    std::cout << name << ": " << table.n_rows() << " cycles" << std::endl;
    check("  the load is right in all", all);
    if (!all)
      std::cout << result.err << table.value("goal_moment", 0) << ", not " << right << std::endl;
  }
} // namespace

int
main()
{
  const double      pi     = std::acos(-1.);
  const std::string refine = " set Strategy = adaptive\n set Refinement indicator = residual\n"
                             " set Growth = 3\n set Maximum cycles = 3\n";
  const std::string box    = " set Type = box\n set Upper corner = 2, 1, .5\n set Size = .35\n";
  in_every_cycle("strip",
                 body(box, traction("l", "z > .5 - 1e-9 && x < .7 + 1e-9", "-2"), refine),
                 -2. * .7 * .5,
                 1e-8);
  in_every_cycle("patch",
                 body(box,
                      traction("l", "z > .5 - 1e-9 && abs(x - 1.2) < .15 && abs(y - .4) < .2", "3")
                        + traction("m", "z > .5 - 1e-9 && (x < .3 && y < .5 || x + y > 2.6)", "1"),
                      refine + " set Coarsening = yes\n"),
                 .5 * (3. * .3 * .4 + .15 + .08),
                 1e-8);
  in_every_cycle("disc",
                 body(box, traction("l", "sphere(.8,.55,.5, .3)", "-1"), refine),
                 -.5 * .09 * pi,
                 1e-3);
  in_every_cycle("blocks",
                 body(" set Type = blocks\n set Blocks = 0,0,0 : 1,1,.5; 1,0,0 : 2,1,.5\n"
                      " set Block regions = 1, 2\n set Size = .35\n",
                      traction("l", "z > .5 - 1e-9 && (x - 1)^2 + (y - .5)^2 < .04", "-1"),
                      refine),
                 -.5 * .04 * pi,
                 1e-3);

  // Bricks cannot be cut: the share is said.
  const std::string bricks
    = " set Type = bricks\n set Upper corner = 2, 1, .5\n set Cells = 4x2x1\n";
  write("bricks.prm", body(bricks, traction("l", "z > .5 - 1e-9 && x < .7", "-2"), ""));
  const auto warned = run("--output-directory " + fresh("bricks").string() + " bricks.prm");
  check("bricks: done", warned.code == 0);
  check("  a warning tells the share", contains(read("bricks/log.txt"), "% of the area is wrong"));
}
