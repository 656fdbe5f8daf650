// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Reading scenes: includes, continued lines, comments, blocks with names of the
// user's choice, settings of the command line, places; nearest names.

#include "tetradapt/scene/nearest_names.h"
#include "tetradapt/scene/scene_reader.h"
#include "tetradapt/scene/words.h"

#include <filesystem>
#include <fstream>
#include <iostream>

using namespace tetradapt::scene;

namespace
{
  void
  write(const std::string &name, const std::string &text)
  {
    std::ofstream(name, std::ios::binary) << text;
  }

  void
  check(const std::string &what, const bool holds)
  {
    std::cout << what << ": " << (holds ? "ok" : "FAILED") << '\n';
  }

  void
  write_scenes()
  {
    std::filesystem::create_directories("parts");
    write("parts/model.prm",
          "subsection Materials\n"
          "  subsection muscle fibre\n"
          "    set Regions = 3, 4\n"
          "    set Young modulus = 1e4\n"
          "  end\n"
          "  subsection bone\n"
          "    set Density = +2.5e-1\n"
          "  end\n"
          "end\n"
          "subsection Mesh\n"
          "  set Type  = file\n"
          "  set Files = a.msh; ../b.vtk\n"
          "end\n");
    write("parts/a.msh", "content");
    write("b.vtk", "content");
    // With a byte order mark, Windows' line ends and tabs.
    write("beam.prm",
          "\xEF\xBB\xBF# comment\r\n"
          "set Title = A \\ # goes on\r\n"
          "            beam # not = this\r\n"
          "set Degree=2\r\n"
          "\r\n"
          "include parts/model.prm\r\n"
          "subsection\tMaterials\r\n"
          "  subsection bone\r\n"
          "    set Young modulus = 17e3\r\n"
          "  end\r\n"
          "end\r\n"
          "subsection Supports\r\n"
          "  subsection b\r\n"
          "    set Where = x<=1e-9 && y==0\r\n"
          "  end\r\n"
          "  subsection a\r\n"
          "    set Boundary ids = 3, -1\r\n"
          "    set Components = z, x\r\n"
          "    set Displacement = 1e-3*y; 0; if(x>1, 2, 3)\r\n"
          "  end\r\n"
          "end\r\n"
          "subsection Loads\r\n"
          "  subsection heat\r\n"
          "    set Type = temperature\r\n"
          "    set Value = 10*x\r\n"
          "    set Regions = 3\r\n"
          "  end\r\n"
          "end\r\n"
          "subsection Adaptivity\r\n"
          "  set Strategy = mesh list\r\n"
          "  set Marking = fixed fraction\r\n"
          "end\r\n"
          "subsection Reference\r\n"
          "  set Mesh = file\r\n"
          "end");
  }

  void
  check_scene(const Scene &scene)
  {
    const auto here = std::filesystem::current_path();
    check("name and file", scene.name == "beam" && scene.file == "beam.prm");
    check("title over two lines", scene.title == "A beam");
    check("degree without blanks", scene.degree == 2);
    check("two materials in order",
          scene.materials.size() == 2 && scene.materials[0].name == "muscle fibre"
            && scene.materials[1].name == "bone");
    check("regions", scene.materials[0].regions == std::vector<int>{3, 4});
    check("included block goes on",
          scene.materials[1].density == 0.25
            && scene.materials[1].constants.at("Young modulus") == 17e3);
    check("default stays", scene.materials[1].constants.at("Poisson ratio") == 0.3);
    check("files count from the including file",
          scene.mesh.files
            == std::vector<std::string>{(here / "parts/a.msh").string(),
                                        (here / "b.vtk").string()});
    check("supports in order", scene.supports[0].name == "b" && scene.supports[1].name == "a");
    check("= in a value", scene.supports[0].selector.where == "x<=1e-9 && y==0");
    check("ids", scene.supports[1].selector.ids == std::vector<int>{3, -1});
    check("components", scene.supports[1].components == std::array<bool, 3>{{true, false, true}});
    check("commas in an expression", scene.supports[1].displacement[2] == "if(x>1, 2, 3)");
    check("scalar load", scene.loads[0].value[0] == "10*x");
    check("load on regions", scene.loads[0].selector.ids == std::vector<int>{3});
    check("words",
          word(scene.adaptivity.strategy) == "mesh list"
            && word(scene.adaptivity.marking) == "fixed fraction");
  }

  void
  check_places(const Scene &scene)
  {
    for (const char *message : {"Supports/a/Displacement, component x: text",
                                "Materials/muscle fibre/Density: text",
                                "Materials/bone/Density: text",
                                "Supports/b selects nothing",
                                "Degree: text",
                                "Solver/Type: text",
                                "Mesh files differ",
                                "no name at all"})
      std::cout << scene.with_place(message) << '\n';
  }

  void
  check_settings()
  {
    const Scene scene = read_scene("beam.prm",
                                   {"Degree=1",
                                    "Supports/a/Displacement = 0; 0; if(x==1, 2, 3)",
                                    "Materials/bone/Young modulus=1",
                                    "Materials/bone/Young modulus=2",
                                    "Mesh/Files=b.vtk;parts/a.msh"});
    check("setting at the top", scene.degree == 1);
    check("setting with =", scene.supports[1].displacement[2] == "if(x==1, 2, 3)");
    check("last setting wins", scene.materials[1].constants.at("Young modulus") == 2.);
    check("files count from here",
          scene.mesh.files[0] == (std::filesystem::current_path() / "b.vtk").string());
    std::cout << scene.with_place("Materials/bone/Young modulus: text") << '\n';
    for (const auto &warning : scene.warnings())
      std::cout << "warning: " << warning << '\n';
  }

  void
  check_nearest_names()
  {
    std::cout << "distances: " << edit_distance("kitten", "sitting") << ' '
              << edit_distance("", "abc") << ' ' << edit_distance("Mehs", "mesh") << ' '
              << edit_distance("ca", "abc") << ' ' << edit_distance("same", "SAME") << '\n';
    const std::vector<std::string> valid{"Young modulus", "Poisson ratio", "Density", "Law"};
    for (const char *name : {"Youngs modulus", "dens", "Posson ratio", "Lwa", "Mass", "x"})
      std::cout << name << ": " << suggest(name, valid) << '\n';
  }
} // namespace

int
main()
{
  write_scenes();
  // The thermal load needs a material that expands.
  const Scene scene = read_scene("beam.prm", {"Materials/muscle fibre/Thermal expansion=1e-5"});
  check_scene(scene);
  check_places(scene);
  check_settings();
  check_nearest_names();
}
