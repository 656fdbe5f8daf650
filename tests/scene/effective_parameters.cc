// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The complete input that a run writes gives the same scene when it is read
// again, for the scenes in prm/ and for one in which nothing is a default; what
// --print-parameters prints can be read as well.

#include "tetradapt/scene/parameter_printer.h"
#include "tetradapt/scene/scene_reader.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace tetradapt::scene;

namespace
{
  void
  write(const std::string &name, const std::string &text)
  {
    std::ofstream(name, std::ios::binary) << text;
  }

  /** Without the comment in the first line, which names the file. */
  std::string
  body(const std::string &text)
  {
    return text.substr(text.find('\n') + 1);
  }

  Scene
  check_round_trip(const std::string &what, const std::string &file)
  {
    const Scene       scene = read_scene(file);
    const std::string first = effective_parameters(scene);
    write("again.prm", first);
    const Scene again = read_scene("again.prm");
    std::cout << what << ": "
              << (body(effective_parameters(again)) == body(first) ? "same" : "DIFFERENT") << ", "
              << std::count(first.begin(), first.end(), '=') << " signs =\n";
    return again;
  }

  /** The effective parameters of a scene with every value changed. */
  void
  change_everything(const std::string &file)
  {
    Scene scene                         = read_scene(file);
    scene.title                         = "Übung № 1";
    scene.degree                        = 2;
    scene.mesh.source                   = MeshSource::bricks;
    scene.mesh.lower_corner             = Point<3>(-0.1, 1. / 3., 1e-300);
    scene.mesh.upper_corner             = Point<3>(1e22, 2., 3.);
    scene.mesh.cells                    = {{{2, 3, 4}}, {{5, 6, 7}}};
    scene.mesh.feature_angle            = 12.5;
    scene.tetgen                        = {1.2, 15., 3, 5, 1000, true, 0.1, 100.};
    auto &material                      = scene.materials[0];
    material.regions                    = {1, -2};
    material.region_groups              = {"a b", "c"};
    material.constants["Poisson ratio"] = -0.123456789012345678;
    material.thermal_expansion          = 1.7e-5;
    auto &support                       = scene.supports[0];
    support.selector                    = {{7}, {"x-min"}, "x < 1 && y > 0"};
    support.components                  = {{true, true, false}};
    support.displacement                = {{"sin(y)", "if(x > 0, 1, 2)", "0"}};
    scene.supports.resize(4, support);
    scene.supports[1].name                  = "other";
    scene.supports[1].components            = {{false, true, true}};
    scene.supports[1].displacement          = {{"0", "0", "z"}};
    scene.supports[1].selector              = {};
    scene.supports[1].place.line            = {{-1. / 3., 0., 1e-300}, {1., 2., 3.}};
    scene.supports[1].place.excluded_radius = 0.;
    for (unsigned int s : {2, 3})
      {
        scene.supports[s]              = SupportParameters();
        scene.supports[s].selector.ids = {static_cast<int>(s)};
      }
    scene.supports[2].name                = "slope";
    scene.supports[2].type                = SupportType::sliding;
    scene.supports[2].normal_displacement = "0.01 * x";
    scene.supports[3].name                = "plate";
    scene.supports[3].type                = SupportType::rigid;
    scene.supports[3].rigid               = {Point<3>(0., 1. / 3., 2.),
                                             {{0.1, std::nullopt, -1e-300}},
                                             {{std::nullopt, 0., std::nullopt}},
                                             {{"0", "2*pi", "0"}},
                                             {{"1", "0", "-1"}}};
    scene.loads[0].type                   = LoadType::gravity;
    scene.loads[0].selector               = {{1}, {"a b"}, ""};
    material.density                      = 1000;
    scene.loads[0].value                  = {{"0", "-9.81*y", "x"}};
    scene.solver                          = {SolverParameters::Type::cg, 1e-12, 7, 8};
    scene.reference.type                  = ReferenceParameters::Type::fine_mesh;
    scene.reference.route                 = ReferenceParameters::MeshRoute::bricks;
    scene.reference.cells                 = {{9, 8, 7}};
    scene.reference.cache                 = false;
    scene.exact_solution.displacement     = {{"x", "y", "z"}};
    scene.exact_solution.gradient         = {{"1", "0", "0", "0", "1", "0", "0", "0", "1"}};
    scene.exact_solution.strain_energy    = 4.00414;
    scene.adaptivity.strategy             = AdaptivityParameters::Strategy::mesh_list;
    scene.adaptivity.refinement_indicator = AdaptivityParameters::RefinementIndicator::ren;
    scene.adaptivity.marking              = AdaptivityParameters::Marking::doerfler;
    scene.adaptivity.size_control         = AdaptivityParameters::SizeControl::volume_constraints;
    scene.adaptivity.max_tets             = 123456789012;
    scene.output                          = {"some/folder", false, false, false};
    write("changed.prm", effective_parameters(scene));
  }

  void
  put_on_springs(const std::string &file)
  {
    Scene scene                    = read_scene(file);
    scene.supports[0].type         = SupportType::spring;
    scene.supports[0].components   = {{false, false, false}};
    scene.supports[0].displacement = {{"0.1*x", "0", "z"}};
    scene.supports[0].spring       = {"1 + 2*x", SpringDirection::all};
    write("springs.prm", effective_parameters(scene));
  }
} // namespace

int
main()
{
  const std::string prm = SOURCE_DIR "/../../prm/";
  for (const char *name : {"quickstart",
                           "report/table_4_1",
                           "verification/cantilever_p1",
                           "verification/cantilever_p2",
                           "verification/manufactured_p1",
                           "verification/manufactured_p2"})
    check_round_trip(name, prm + name + ".prm");

  put_on_springs(prm + "quickstart.prm");
  check_round_trip("springs", "springs.prm");
  change_everything(prm + "quickstart.prm");
  const Scene scene = check_round_trip("everything changed", "changed.prm");
  std::cout << "digits kept: "
            << (scene.materials[0].constants.at("Poisson ratio") == -0.123456789012345678
                && scene.mesh.lower_corner == Point<3>(-0.1, 1. / 3., 1e-300))
            << ", large number kept: " << scene.adaptivity.max_tets
            << ", bricks: " << scene.mesh.cells.size()
            << ", expression kept: " << scene.supports[0].displacement[1]
            << ", title kept: " << (scene.title == "Übung № 1") << '\n';

  // All parameters; the blocks need names, support and load faces, and a body something that moves
  // it.
  std::ostringstream printed;
  print_parameters(printed, ParameterFormat::prm);
  std::string text = printed.str();
  for (auto at = text.find("<name>"); at != std::string::npos; at = text.find("<name>"))
    text.replace(at, 6, "some");
  text.replace(text.find("Value = 0;"), 10, "Value = 1;");
  for (const std::string name : {"Parameters", "Values"})
    {
      const auto end = text.find("\n", text.find("set " + name + " "));
      text.insert(end, name == "Values" ? " 1" : " Degree");
    }
  auto at = text.find("subsection Supports");
  for (unsigned int block = 0; block < 2; ++block)
    {
      at = text.find("\n", text.find("set Where ", at));
      text.insert(at, " everywhere");
    }
  write("printed.prm", text);
  const Scene all = check_round_trip("all parameters", "printed.prm");
  std::cout << "places known: " << all.places.size() << '\n';

  std::ostringstream markdown, json;
  print_parameters(markdown, ParameterFormat::markdown);
  print_parameters(json, ParameterFormat::json);
  const std::string rows = markdown.str(), keys = json.str();
  std::size_t       n_rows = 0, n_keys = 0;
  for (auto at = rows.find("\n| "); at != std::string::npos; at = rows.find("\n| ", at + 1))
    ++n_rows;
  for (auto at = keys.find("default_value"); at != std::string::npos;
       at      = keys.find("default_value", at + 1))
    ++n_keys;
  // Eleven tables have a line of headings.
  std::cout << "rows in Markdown: " << n_rows - 14 << ", parameters in JSON: " << n_keys << '\n';
}
