// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Loads on faces that supports hold, by their share of the area.

#include "tetradapt/mechanics/held_loads.h"

#include "bodies.h"

using namespace bodies;

namespace
{
  using scene::LoadType;

  /** The scene on a box 3 x 2 x 1, and what is told about it. */
  void
  look(const std::string &what, const scene::Scene &scene)
  {
    auto body = box(Point<3>(3., 2., 1.), {{6, 4, 2}}, 0.);
    select(*body, scene);
    std::cout << what << ":\n";
    for (const auto &held : mechanics::held_loads(scene, *body))
      {
        std::cout << "  " << held.name << ": area " << held.area << ", held " << held.held_area
                  << ", partly " << held.partly_area;
        for (const auto &support : held.supports)
          std::cout << ", " << support;
        std::cout << '\n';
      }
    for (const auto &warning : mechanics::held_load_warnings(scene, *body))
      std::cout << "  " << warning << '\n';
  }

  scene::Scene
  with(const std::vector<scene::SupportParameters> &supports,
       const std::vector<scene::LoadParameters>    &loads)
  {
    scene::Scene scene;
    scene.supports = supports;
    scene.loads    = loads;
    return scene;
  }
} // namespace

int
main()
{
  const auto foot = support("foot", "x < 1e-9");
  look("apart", with({foot}, {load("tip", LoadType::traction, "x > 3-1e-9", {{"1", "2", "3"}})}));
  look("the same face",
       with({foot}, {load("tip", LoadType::traction, "x < 1e-9", {{"0", "x", "3"}})}));
  look("a quarter of the top",
       with({foot, support("strip", "z > 1-1e-9 && y < 0.5 + 1e-9")},
            {load("snow", LoadType::pressure, "z > 1-1e-9", {{"4", "0", "0"}}),
             load("side", LoadType::traction, "x > 3-1e-9", {{"0", "0", "3"}})}));
  look("a roller across the load",
       with({foot, support("roller", "y < 1e-9", "y")},
            {load("shear", LoadType::traction, "y < 1e-9", {{"1", "0", "0"}})}));
  auto pin = load("pin", LoadType::total_force, "x < 1e-9 || y < 1e-9", {{"1", "0", "0"}});
  pin.total.distribution = scene::Distribution::bearing;
  look("a pin on a support", with({foot}, {pin}));
  look("a pin beside a support", with({support("roller", "y < 1e-9", "y")}, {pin}));
  pin.total.distribution = scene::Distribution::even;
  look("an even force there", with({support("roller", "y < 1e-9", "y")}, {pin}));
  pin.total.moment = {{"0", "0", "1"}};
  look("a moment there", with({support("roller", "y < 1e-9", "y")}, {pin}));
  look("a roller along the load",
       with({foot, support("roller", "y < 1e-9", "y")},
            {load("gas", LoadType::pressure, "y < 1e-9", {{"1", "0", "0"}}),
             load("push", LoadType::nodal_force, "y < 1e-9", {{"1", "1", "0"}})}));
  look("two rollers that hold it together",
       with({foot,
             support("left", "y < 1e-9 && x > 1 - 1e-9", "y"),
             support("low", "y < 1e-9 && x < 2 + 1e-9", "z")},
            {load("push", LoadType::traction, "y < 1e-9", {{"0", "1", "1"}})}));
}
