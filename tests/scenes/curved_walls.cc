// SPDX-License-Identifier: AGPL-3.0-or-later
//
// On curved walls under load, which the boundary is projected on, the recovery takes points and
// normals of the walls themselves: its effectivity stays near one in adaptive cycles, for
// pressures and for tractions that use the normal. With facets' normals it rises without end, and
// with patches of few cells at the walls, too, where the refinement is by another indicator.

#include "program.h"

using namespace program;

namespace
{
  void
  effectivity(const std::string &name,
              const double       lower,
              const double       upper,
              const std::string &options
              = "--set Adaptivity/Growth=2.5 --set 'Adaptivity/Maximum tetrahedra=12000'")
  {
    const fs::path folder = fresh(name);
    const auto     result
      = run("--quiet --output-directory " + name + " --set 'Adaptivity/Maximum cycles=8' " + options
            + " " + scene("verification/" + name + ".prm"));
    std::cout << name << ": exit code " << result.code << '\n'
              << (result.code == 0 ? "" : result.err);
    const Table table(folder);
    bool        good = table.n_rows() > 3;
    for (unsigned int i = 1; i <= 3 && good; ++i)
      {
        const double value = table.value("effectivity_spr", table.n_rows() - i);
        good               = value >= lower && value <= upper;
        if (!good)
          std::cout << "  " << value << std::endl;
      }
    std::cout << "  effectivity from " << lower << " to " << upper
              << " in the last three cycles: " << (good ? "yes" : "NO") << std::endl;
  }
} // namespace

int
main()
{
  for (const std::string body : {"lame_sphere", "lame_cylinder", "lame_ellipsoid"})
    {
      effectivity(body + "_p1", 0.8, 1.1);
      effectivity(body + "_p2", 0.85, 1.15);
      effectivity(body + "_nu5_mixed", 0.85, 1.15);
    }
  effectivity("lame_cylinder_nu5_mixed",
              0.85,
              1.15,
              "--set Adaptivity/Growth=3 --set 'Adaptivity/Maximum tetrahedra=40000' "
              "--set 'Adaptivity/Refinement indicator=residual' --set Estimation/Estimators=spr");
}
