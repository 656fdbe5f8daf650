// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The loop that is safe: worse meshes are rejected, cells grow, curved boundaries are
// followed, sizes are kept and used again, conjugate gradients stop in time.

#include "program.h"

using namespace program;

namespace
{
  const std::string beam = "'" + scene("reuse/beam.prm") + "'";

  /** A rule that coarsens a fine mesh almost everywhere, with linear elements: a worse mesh. */
  void
  rejection()
  {
    std::cout << "rejection" << std::endl;
    const std::string settings
      = "--set Degree=1 --set 'Mesh/Volume bound=0.004' --set Adaptivity/Marking=maximum "
        "--set Adaptivity/Lambda=0.9 --set 'Adaptivity/Minimum new fraction=0.001' "
        "--set 'Adaptivity/Maximum cycles=4' "
        + beam;
    const auto   result = run("--output-directory " + fresh("safe").string() + " " + settings);
    const Table  table("safe");
    bool         falls = true, some = false;
    double       last     = 1e300;
    unsigned int accepted = 0;
    for (unsigned int row = 0; row < table.n_rows(); ++row)
      if (table.value("accepted", row) == 1.)
        {
          falls = falls && table.value("relative_energy_error", row) < last;
          last  = table.value("relative_energy_error", row);
          ++accepted;
        }
      else
        some = some || std::isnan(table.value("relative_energy_error", row));
    check("  done, four cycles accepted", result.code == 0 && accepted == 4);
    check("  some mesh rejected, its row without an error", some);
    check("  announced", contains(result.err, "the solution is worse, and the mesh is rejected"));
    check("  the error of accepted cycles falls", falls);
    run("--quiet --output-directory " + fresh("unsafe").string() + " --set Adaptivity/Safeguard=no "
        + settings);
    const Table unsafe("unsafe");
    check("  without the safeguard it rises", !unsafe.falls("relative_energy_error"));
    bool all = true;
    for (unsigned int row = 0; row < unsafe.n_rows(); ++row)
      all = all && unsafe.value("accepted", row) == 1.;
    check("  and nothing is rejected", all && unsafe.n_rows() == 4);
  }

  /** Cells of a regular mesh, some of which TetGen cuts and turns: worse than before, and
   * again when more are cut. */
  void
  two_rejections()
  {
    std::cout << "two rejections" << std::endl;
    write("twice.prm", R"(
subsection Mesh
  set Type         = bricks
  set Upper corner = 3, 1, 1
  set Cells        = 8x2x2
end
subsection Materials
  subsection m
    set Young modulus = 1000
    set Poisson ratio = 0.45
  end
end
subsection Supports
  subsection s
    set Groups = x-min
  end
end
subsection Loads
  subsection l
    set Groups = x-max
    set Value  = 1; 0; 0
  end
end
subsection TetGen
  set Radius-edge ratio  = 2
  set Optimisation level = 0
end
subsection Adaptivity
  set Strategy             = adaptive
  set Refinement indicator = spr
  set Marking              = fixed fraction
  set Fraction             = 0.03
  set Reduction            = 0.7
  set Maximum cycles       = 2
end
)");
    const auto  result = run("--output-directory twice twice.prm");
    const Table table("twice");
    check("  two meshes rejected, then one accepted",
          result.code == 0 && table.n_rows() == 4 && table.value("accepted", 0) == 1.
            && table.value("accepted", 1) == 0. && table.value("accepted", 2) == 0.
            && table.value("accepted", 3) == 1.);
    check("  which has eight times the tetrahedra of the first",
          table.value("tets", 3) == 8. * table.value("tets", 0));
    check("  and more energy", table.value("strain_energy", 3) > table.value("strain_energy", 0));
    check("  announced", contains(result.err, "each cut into eight"));
    const auto limited
      = run("--output-directory twice --set 'Adaptivity/Maximum tetrahedra=1000' twice.prm");
    check("  not beyond a limit: the run says so",
          limited.code == 0 && Table("twice").n_rows() == 3
            && contains(limited.err, "two meshes made from the mesh of cycle 0"));
  }

  void
  growing_cells()
  {
    std::cout << "cells that grow" << std::endl;
    const std::string settings = " --set Degree=1 --set 'Mesh/Volume bound=0.002' "
                                 "--set Adaptivity/Growth=1.05 --set 'Adaptivity/Maximum cycles=2' "
                                 + beam;
    run("--quiet --output-directory " + fresh("grown").string() + settings);
    run("--quiet --output-directory " + fresh("again").string() + settings);
    const Table table("grown");
    check("  fewer tetrahedra", table.value("tets", 1) < table.value("tets", 0));
    check("  less error",
          table.value("relative_energy_error", 1) < 0.95 * table.value("relative_energy_error", 0));
    check("  the same mesh in every run, byte by byte",
          !read("grown/size_field.vtu").empty()
            && read("grown/size_field.vtu") == read("again/size_field.vtu"));
  }

  void
  kept_sizes()
  {
    std::cout << "kept sizes" << std::endl;
    run("--quiet --output-directory " + fresh("full").string() + " --set Adaptivity/Tolerance=0.03 "
        + beam);
    const std::string reuse
      = " --set 'Mesh/Size field=" + fs::absolute("full/size_field.vtu").string() + "' '"
        + scene("reuse/beam_reused.prm") + "'";
    const auto  result = run("--output-directory " + fresh("reused").string() + reuse);
    const Table full("full"), reused("reused");
    check("  done in one cycle", result.code == 0 && reused.n_rows() == 1);
    check("  about as many tetrahedra",
          std::abs(std::log(reused.last("tets") / full.last("tets"))) < std::log(1.3));
    check("  about the error of the full run",
          reused.last("relative_energy_error") < 1.15 * full.last("relative_energy_error"));
    write("wrong.vtu", "<VTKFile type=\"UnstructuredGrid\"></VTKFile>");
    const auto wrong
      = run("--quiet --output-directory " + fresh("wrong").string() + " --set 'Mesh/Size field="
            + fs::absolute("wrong.vtu").string() + "' '" + scene("reuse/beam_reused.prm") + "'");
    check("  a file without sizes is refused", wrong.code == 2 && contains(wrong.err, "wrong.vtu"));
  }

  void
  early_stop()
  {
    std::cout << "conjugate gradients" << std::endl;
    const std::string settings = " --set Solver/Type=cg --set Adaptivity/Coarsening=no " + beam;
    run("--quiet --output-directory " + fresh("residual").string() + settings);
    run("--quiet --output-directory " + fresh("early").string()
        + " --set Solver/Stopping=discretisation" + settings);
    const Table residual("residual"), early("early");
    check("  less than half the iterations",
          early.last("iterations") > 0.
            && early.last("iterations") < 0.5 * residual.last("iterations"));
    check("  the error within 1 %",
          std::abs(early.last("relative_energy_error") / residual.last("relative_energy_error")
                   - 1.)
            < 0.01);
    check("  the algebraic error below a tenth of the estimate",
          early.last("algebraic_error_estimate") < 0.1 * early.last("estimate"));
  }

  void
  sphere()
  {
    std::cout << "thick sphere" << std::endl;
    run("--quiet --output-directory " + fresh("sphere").string()
        + " --set 'Adaptivity/Maximum cycles=5' '" + scene("verification/lame_sphere_p1.prm")
        + "'");
    const Table table("sphere");
    const auto  ratio
      = [&](const char *name) { return table.value(name, 4) / table.value(name, 2); };
    const double order = -std::log(ratio("relative_energy_error")) / std::log(ratio("dofs"));
    check("  the exact error falls in every cycle", table.falls("relative_energy_error"));
    check("  with the unknowns to the power 0.3 to 0.4", order > 0.3 && order < 0.4);
    check("  effectivity 0.9 to 1.1", std::abs(table.last("effectivity") - 1.) < 0.1);
    // 24 tetrahedra have 2.574958 of the volume 7 pi/6.
    check("  the volume within 1 % of the true one",
          std::abs((1. + table.last("volume_drift")) * 2.574958 / 3.665191 - 1.) < 0.01);
  }
} // namespace

int
main()
{
  rejection();
  two_rejections();
  growing_cells();
  kept_sizes();
  early_stop();
  sphere();
}
