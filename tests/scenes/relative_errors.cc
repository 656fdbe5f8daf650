// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Relative errors are of the stress energy where temperatures act, in both forms and however the
// error is known; where there is no stress they are zero or left out, never noise over noise.

#include "program.h"

using namespace program;

namespace
{
  /** A block between smooth walls, heated by 3 x^2. lambda = mu = 40, and it moves along x only:
   * u' = (3 lambda + 2 mu) / (lambda + 2 mu) alpha (3 x^2 - 1) = 5/3 0.02 (3 x^2 - 1). */
  const std::string slab = R"(
set Degree = 2
subsection Mesh
  set Type         = bricks
  set Upper corner = 1, 0.5, 0.5
  set Cells        = 4x2x2
end
subsection Materials
  subsection m
    set Young modulus     = 100
    set Poisson ratio     = 0.25
    set Thermal expansion = 0.02
  end
end
subsection Supports
  subsection ends
    set Groups     = x-min, x-max
    set Components = x
  end
  subsection y
    set Groups     = y-min, y-max
    set Components = y
  end
  subsection z
    set Groups     = z-min, z-max
    set Components = z
  end
end
subsection Loads
  subsection heat
    set Type  = temperature
    set Value = 3*x^2
  end
end
subsection Estimation
  set Estimators = spr
end
subsection Output
  set VTU = no
end
)";

  const std::string free_block = R"(
set Degree = 2
subsection Mesh
  set Type         = bricks
  set Upper corner = 2, 1, 1.5
  set Cells        = 4x2x3
end
subsection Materials
  subsection m
    set Young modulus     = 70000
    set Poisson ratio     = 0.33
    set Thermal expansion = 2e-5
  end
end
subsection Supports
  subsection x
    set Groups     = x-min
    set Components = x
  end
  subsection y
    set Groups     = y-min
    set Components = y
  end
  subsection z
    set Groups     = z-min
    set Components = z
  end
end
subsection Loads
  subsection heat
    set Type  = temperature
    set Value = 150
  end
end
subsection Estimation
  set Estimators = spr
end
subsection Output
  set VTU = no
end
)";

  const std::string turned = R"(
subsection Mesh
  set Type         = bricks
  set Upper corner = 1, 1, 1
  set Cells        = 3x3x3
end
subsection Materials
  subsection m
    set Young modulus = 1000
    set Poisson ratio = 0.2
  end
end
subsection Supports
  subsection clamp
    set Groups       = x-min
    set Displacement = -0.01*y; 0.01*x; 0
  end
end
subsection Exact solution
  set Displacement = -0.01*y; 0.01*x; 0
end
subsection Estimation
  set Estimators = spr
end
subsection Output
  set VTU = no
end
)";

  /** int sigma : C^-1 : sigma of the slab's exact solution. */
  double
  exact_stress_energy()
  {
    const double   lambda = 40., mu = 40., alpha = 0.02, volume = 0.25;
    const double   K3  = 3. * lambda + 2. * mu;
    double         sum = 0.;
    const unsigned n   = 20000;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double x = (i + 0.5) / n, free = alpha * 3. * x * x;
        // Equilibrium: (lambda + 2 mu) u' - K3 alpha T is constant, u vanishes at both ends.
        const double strain = K3 / (lambda + 2. * mu) * (free - alpha);
        const double a = strain - free, b = -free, trace = a + 2. * b;
        sum += volume / n * (lambda * trace * trace + 2. * mu * (a * a + 2. * b * b));
      }
    return sum;
  }

  void
  heated_slab()
  {
    const double      exact = exact_stress_energy();
    const double      norm  = std::sqrt(exact);
    const std::string truth
      = "--set 'Exact solution/Displacement=" + std::string("(5/3)*0.02*(x^3-x); 0; 0'");
    std::cout << "heated slab" << std::endl;
    for (const std::string form : {"displacement", "mixed"})
      {
        const Table table = table_of("slab_" + form, slab, truth + " --set Formulation=" + form);
        std::cout << ' ' << form << std::endl;
        check("  error is seen", table.last("energy_error") > 1e-3 * norm);
        check("  relative to the exact stress energy",
              near(table.last("energy_error") / table.last("relative_energy_error"), norm, 1e-6));
        check("  the estimate to the same",
              near(table.last("estimate_spr") / table.last("relative_estimate_spr"), norm, 1e-6));
        const Table alone = table_of("alone_" + form, slab, "--set Formulation=" + form);
        check("  an estimate alone to the computed one",
              near(alone.last("estimate_spr") / alone.last("relative_estimate_spr"), norm, 1e-3));
        const Table reference
          = table_of("reference_" + form,
                     slab,
                     "--set Formulation=" + form
                       + " --set 'Reference/Type=fine mesh' --set Reference/Mesh=bricks "
                         "--set Reference/Cells=8x4x4 --set Reference/Cache=no "
                         "--set Estimation/Estimators=energy");
        check("  relative to the reference's",
              near(reference.last("energy_error") / reference.last("relative_energy_error"),
                   norm,
                   1e-3));
      }
    std::ostringstream energy;
    energy.precision(12);
    energy << "--set 'Exact solution/Strain energy=" << 0.5 * exact << "'";
    const Table known = table_of("known", slab, energy.str());
    check(" a known energy: the error over the stress energy",
          near(known.last("energy_error") / known.last("relative_energy_error"), norm, 1e-3));
    const Table boxes = table_of("boxes",
                                 slab,
                                 "--set Reference/Type=hexahedra --set Reference/Cache=no "
                                 "--set Estimation/Estimators=energy");
    check(" a reference on hexahedra",
          near(boxes.last("energy_error") / boxes.last("relative_energy_error"), norm, 1e-3));
    const Table large = table_of("tolerance",
                                 slab,
                                 "--set Degree=1 --set Adaptivity/Strategy=uniform "
                                 "--set Adaptivity/Tolerance=0.1 "
                                   + truth);
    check(" a tolerance",
          large.n_rows() > 1 && large.last("energy_error") <= 0.1 * norm
            && large.value("energy_error", large.n_rows() - 2) > 0.1 * norm);
  }

  void
  nothing()
  {
    const std::string truth = "--set 'Exact solution/Displacement=0.003*x; 0.003*y; 0.003*z'";
    std::cout << "no stress: error and estimate are" << std::endl;
    const auto zero = [](const std::string &what, const Table &table) {
      check("  " + what,
            table.last("relative_energy_error") == 0. && table.last("relative_estimate_spr") == 0.
              && !table.has("effectivity_spr"));
    };
    for (const std::string options : {"--set Formulation=mixed",
                                      "--set Degree=1",
                                      "--set Solver/Type=cg",
                                      "--set Solver/Type=direct"})
      zero("free heating, " + options, table_of("free", free_block, truth + " " + options));
    const Table alone = table_of("free_alone", free_block, "--set Solver/Type=cg");
    check("  free heating without an exact solution", alone.last("relative_estimate_spr") == 0.);
    const Table adaptive = table_of("free_adaptive",
                                    free_block,
                                    "--set Adaptivity/Strategy=adaptive "
                                    "--set 'Adaptivity/Refinement indicator=spr' "
                                    "--set Adaptivity/Tolerance=0.01");
    check("  an adaptive run ends at once", adaptive.n_rows() == 1);
    zero("a body that turns", table_of("turned", turned, ""));
    // Free heating that linear elements cannot follow: their stress is all error.
    const Table bent
      = table_of("bent",
                 free_block,
                 "--set Degree=1 --set Loads/heat/Value=100*x "
                 "--set 'Supports/x/Displacement=-0.001*(y^2+z^2); 0; 0' "
                 "--set 'Exact solution/Displacement=0.001*(x^2-y^2-z^2); 0.002*x*y; "
                 "0.002*x*z'");
    check("error without a relative one",
          bent.last("energy_error") > 0. && std::isnan(bent.last("relative_energy_error")));
  }
} // namespace

int
main()
{
  heated_slab();
  nothing();
}
