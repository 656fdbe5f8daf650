// SPDX-License-Identifier: AGPL-3.0-or-later
//
// nx, ny, nz in loads on a surface: with them a pressure can be written as a traction, wherever
// loads are evaluated; nowhere else are they known.

#include "program.h"

using namespace program;

namespace
{
  const std::string common = R"(
subsection Materials
  subsection m
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Supports
  subsection bottom
    set Groups = z-min
  end
end
subsection Reference
  set Cache = no
end
subsection Output
  set VTU = no
end
)";

  const std::string body = R"(
subsection Mesh
  set Type         = bricks
  set Upper corner = 1, 2, 1
  set Cells        = 2x3x2
end
)" + common;

  std::string
  load(const std::string &type, const std::string &value)
  {
    return "subsection Loads\n  subsection l\n    set Type = " + type
           + "\n    set Groups = x-max, y-min, z-max\n    set Value = " + value + "\n  end\nend\n";
  }

  void
  equal()
  {
    for (const std::string options :
         {"--set Degree=1 --set 'Estimation/Estimators=spr, residual, averaging, degree "
          "extrapolation, local degree extrapolation, equilibrated'",
          "--set Degree=2 --set 'Estimation/Estimators=spr, residual, averaging, equilibrated'",
          "--set Degree=2 --set Reference/Type=hexahedra --set Estimation/Estimators=energy",
          "--set Degree=2 --set Formulation=mixed --set Estimation/Estimators=spr"})
      {
        const Table pressure = table_of("pressure", body + load("pressure", "1 + x*y"), options);
        const Table traction
          = table_of("traction",
                     body + load("traction", "-(1+x*y)*nx; -(1+x*y)*ny; -(1+x*y)*nz"),
                     options);
        check("a pressure as a traction, " + options, pressure.distance(traction) < 1e-6);
      }
    const Table plain = table_of("plain", body + load("pressure", "x"), "");
    const Table value = table_of("value", body + load("pressure", "x*(nx^2+ny^2+nz^2)"), "");
    check("in the value of a pressure", plain.distance(value) < 1e-9);
  }

  void
  refused()
  {
    const auto fails = [](const std::string &what, const std::string &text) {
      write("refused.prm", text);
      const auto result = run("--validate --quiet refused.prm");
      check("refused: " + what,
            result.code == 2 && contains(result.err, "nx") && contains(result.err, "refused.prm"));
    };
    fails("in a body force",
          body
            + "subsection Loads\n  subsection w\n    set Type = body force\n    set Value = nx; 0; "
              "0\n  end\nend\n");
    fails("in a selection",
          body
            + "subsection Loads\n  subsection w\n    set Where = nx > 0.5\n    set Value = 1; 0; "
              "0\n  end\nend\n");
    fails("in a support",
          body
            + "subsection Supports\n  subsection top\n    set Groups = z-max\n    set Displacement "
              "= nx; 0; "
              "0\n  end\nend\n");
    fails("in a nodal force",
          body
            + "subsection Loads\n  subsection w\n    set Type = nodal force\n    set Groups = "
              "x-max\n    set Value = nx; 0; 0\n  end\nend\n");
  }
} // namespace

int
main()
{
  equal();
  refused();
}
