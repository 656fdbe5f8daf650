// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Names of earlier versions: each is refused with the new one, wherever it stands, and
// contrib/convert_scene turns an old scene into one that means the same.

#include "tetradapt/cli/load_scene.h"

#include "tetradapt/core/exceptions.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace tetradapt;

namespace
{
  const std::string body = R"(subsection Mesh
  set Type = box
end
subsection Materials
  subsection steel
    set Young modulus = 2
    set Poisson ratio = 0.25
  end
end
subsection Supports
  subsection foot
    set Where = x < 1e-9
  end
end
subsection Loads
  subsection pull
    set Groups = x-max
    set Value  = 1; 0; 0
  end
end
)";

  std::string
  content(const std::string &file)
  {
    std::ifstream      in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  void
  write(const std::string &file, const std::string &text)
  {
    std::ofstream(file, std::ios::binary) << text;
  }

  /** Says how the scene @p text with @p settings is refused. */
  void
  refuse(const std::string &text, const std::vector<std::string> &settings = {})
  {
    write("old.prm", text);
    cli::Options options;
    options.settings = settings;
    try
      {
        const scene::Scene scene = cli::load_scene("old.prm", options);
        if (!scene.variations.empty())
          cli::load_study(scene, options);
        std::cout << "ACCEPTED\n";
      }
    catch (const core::InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }

  void
  old_names()
  {
    refuse("subsection Truth\nend\n");
    refuse("subsection Exact solution\n  set Energy = 3\nend\n");
    refuse("subsection Adaptivity\n  set Driver = spr\nend\n");
    refuse("subsection Adaptivity\n  set Route = node sizes\nend\n");
    refuse("subsection Solver\n\n  set Algebraic fraction = 0.2\nend\n");
    for (const std::string setting : {"Truth/Displacement=0; 0; 0",
                                      "Truth/Energy=3",
                                      "Adaptivity/Driver=spr",
                                      "Adaptivity/Route=node sizes",
                                      "Solver/Algebraic fraction=0.2"})
      {
        refuse(body, {setting});
        const auto equals = setting.find('=');
        refuse(body + "subsection Study\n  subsection s\n    set Parameters = Degree & "
               + setting.substr(0, equals) + "\n    set Values = 1 & " + setting.substr(equals + 1)
               + "\n  end\nend\n");
      }
  }

  /** Exit code of the converter; what it prints goes to @p to. */
  int
  convert(const std::string &from, const std::string &to)
  {
    const std::string command
      = "python3 " SOURCE_DIR "/../../contrib/convert_scene " + from + " >" + to + " 2>errors.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  void
  converter()
  {
    const std::string old = body + R"(# Truth and Driver in a comment stay.
subsection Truth   # what is known
  set Energy       = 6.910506 # 6.910506 from a fine mesh
  set Displacement = x; 0; 0
end
subsection Solver
  set Algebraic fraction = 0.25
end
subsection Adaptivity
  set Strategy = adaptive
  set Driver   = spr
  set Route    = volume constraints
end
subsection Study
  subsection Driver
    set Values     = 3 & spr & volume constraints | \ # 3 & spr
                     3.0000000000000001e-5 & residual & node sizes
    set Parameters = Truth/Energy & Adaptivity / Driver & \
                     Adaptivity/Route
  end
  subsection other
    set Parameters = Degree
    set Values = 1 | 2
  end
end
)";
    write("before.prm", old);
    std::cout << "code " << convert("before.prm", "after.prm") << '\n'
              << content("after.prm").substr(body.size());
    const auto scene = cli::load_scene("after.prm", cli::Options());
    const auto runs  = cli::load_study(scene, cli::Options());
    std::cout << "read: " << scene.exact_solution.strain_energy << ' '
              << scene.solver.solver_error_fraction << ", runs " << runs.size() << ", energies "
              << runs[0].scene.exact_solution.strain_energy << ' '
              << runs[2].scene.exact_solution.strain_energy << '\n';
    convert("after.prm", "again.prm");
    std::cout << "what is converted stays as it is: "
              << (content("after.prm") == content("again.prm")) << '\n';

    // A part that a scene includes inside a section; line ends of another system.
    write("part.prm", "set Driver = spr\r\nset Route=node sizes\r\n");
    convert("part.prm", "after.prm");
    std::cout << "part: "
              << (content("after.prm")
                  == "set Refinement indicator = spr\r\nset Size control=node sizes\r\n")
              << '\n';
    write("bad.prm", "subsection Truth\n  set Energy = much\nend\n");
    std::cout << "code " << convert("bad.prm", "after.prm") << ": " << content("errors.txt")
              << "code " << convert("missing.prm", "after.prm") << '\n';
  }
} // namespace

int
main()
{
  old_names();
  converter();
}
