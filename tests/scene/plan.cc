// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What scenes need and skip.

#include "tetradapt/scene/plan.h"
#include "tetradapt/scene/scene_reader.h"

#include <iostream>

using namespace tetradapt::scene;

namespace
{
  void
  print(const std::string &what, const Scene &scene)
  {
    scene.check();
    std::cout << what << '\n';
    for (const auto &stage : Plan(scene).all())
      if (stage.needed)
        std::cout << "  " << stage.name << ": " << stage.reason << '\n';
  }

  void
  say(const std::string &what, const Scene &scene, const Plan::StageId id)
  {
    const Plan plan(scene);
    std::cout << what << ": " << (plan.needs(id) ? "needs" : "skips") << " " << plan.all()[id].name
              << ", " << plan.all()[id].reason << '\n';
  }
} // namespace

int
main()
{
  const std::string prm   = SOURCE_DIR "/../../prm/";
  Scene             scene = read_scene(prm + "quickstart.prm");
  std::cout << Plan(scene).text();

  scene.adaptivity.strategy = AdaptivityParameters::Strategy::none;
  scene.output.vtu          = false;
  print("one mesh, tables", scene);
  scene.output.tables = false;
  print("one mesh, no output", scene);
  scene.output.vtu = true;
  print("one mesh, .vtu only", scene);
  scene.reference.type = ReferenceParameters::Type::none;
  print("one mesh, .vtu only, no reference", scene);

  scene               = read_scene(prm + "quickstart.prm");
  scene.output.tables = scene.output.vtu = false;
  say("driven by energy", scene, Plan::reference_solution);
  say("driven by energy", scene, Plan::nodal_ren);
  scene.adaptivity.refinement_indicator = AdaptivityParameters::RefinementIndicator::ren;
  say("driven by ren", scene, Plan::reference_solution);
  say("driven by ren", scene, Plan::extrapolation);
  scene.exact_solution.displacement = {{"x", "y", "z"}};
  say("driven by ren with an exact solution", scene, Plan::reference_solution);
  scene.adaptivity.refinement_indicator = AdaptivityParameters::RefinementIndicator::exact;
  say("driven by the exact error", scene, Plan::exact_comparison);
  say("driven by the exact error", scene, Plan::reference_error);
  scene.adaptivity.max_cycles = 1;
  say("one cycle", scene, Plan::tetgen_refinement);
  scene.adaptivity.max_cycles = 3;
  scene.adaptivity.marking    = AdaptivityParameters::Marking::doerfler;
  say("doerfler", scene, Plan::marking);
  scene.solver.type = SolverParameters::Type::direct;
  say("direct", scene, Plan::multigrid_solver);
  scene.loads[0].type = LoadType::temperature;
  say("temperature", scene, Plan::thermal_strain);
  scene.materials[0].thermal_expansion = 1e-5;
  say("expansion", scene, Plan::thermal_strain);

  scene = read_scene(prm + "verification/manufactured_p1.prm");
  print("manufactured", scene);
  scene = read_scene(prm + "report/table_4_1.prm");
  print("table 4.1", scene);
  scene = read_scene(prm + "verification/cantilever_p1.prm");
  say("known energy", scene, Plan::known_energy);

  scene.mesh.source              = MeshSource::surface;
  scene.mesh.surface_edge_length = 0.1;
  say("surface", scene, Plan::surface_remeshing);
  say("surface", scene, Plan::tetgen_meshing);
  scene.mesh.source = MeshSource::file;
  say("file", scene, Plan::tetgen_meshing);
  say("file", scene, Plan::initial_refinement);
  scene.mesh.size = "0.1";
  say("file with sizes", scene, Plan::initial_refinement);

  // Every stage stands at the place of its number.
  bool ordered = true;
  for (unsigned int i = 0; i < Plan(scene).all().size(); ++i)
    ordered = ordered && Plan(scene).all()[i].id == i;
  std::cout << "ordered: " << ordered << ", stages: " << Plan(scene).all().size() << '\n';
}
