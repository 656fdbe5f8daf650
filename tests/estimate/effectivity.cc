// SPDX-License-Identifier: AGPL-3.0-or-later
// What a known energy tells about the error, and when it tells nothing.

#include "tetradapt/estimate/effectivity.h"

#include "tetradapt/core/exceptions.h"

#include <iostream>

using namespace tetradapt;
using estimate::Drive;

void
show(const std::string &label, const double known, const double energy, const Drive drive)
{
  const auto result = estimate::error_from_known_energy(known, energy, drive);
  std::cout << label << ": ";
  if (result.error)
    std::cout << *result.error << ", relative " << *result.relative_error;
  else
    std::cout << "none; " << result.warning;
  std::cout << '\n';
}

scene::SupportParameters
support(const std::string &x, const bool held)
{
  scene::SupportParameters support;
  support.name         = "clamp";
  support.components   = {{held, true, true}};
  support.displacement = {{x, "0", "0*3"}};
  return support;
}

void
drives()
{
  const auto print = [](const std::string &label, const scene::Scene &scene) {
    const Drive drive = estimate::drive_of(scene);
    std::cout << label << ": "
              << (drive == Drive::loads          ? "loads"
                  : drive == Drive::displacement ? "displacement"
                                                 : "both")
              << '\n';
  };
  scene::Scene scene;
  scene.loads.resize(1);
  scene.supports = {support("0", true)};
  print("fixed, loaded", scene);
  scene.supports = {support("0.1", false)};
  print("moved in a free direction, loaded", scene);
  scene.supports = {support("0.1", true)};
  print("moved, loaded", scene);
  scene.loads.clear();
  print("moved", scene);
  scene.supports = {support("x*y", true)};
  print("moved by x*y", scene);
  scene.supports = {support("0.1 +", true)};
  try
    {
      estimate::drive_of(scene);
      std::cout << "accepted\n";
    }
  catch (const core::InputError &)
    {
      std::cout << "InputError\n";
    }
}

/** From strain energies: 2 |W - W_h|, and from which side they come. */
void
strain_energies()
{
  using estimate::EnergySide;
  const auto print = [](const std::string &label, const scene::Scene &scene) {
    const EnergySide side   = estimate::strain_energy_side(scene);
    const auto       result = estimate::error_from_strain_energy(2., 1.875, side);
    const auto       above  = estimate::error_from_strain_energy(2., 2.125, side);
    std::cout << label << ": W_h = 1.875: "
              << (result.error ? std::to_string(*result.error) + ", relative "
                                   + std::to_string(*result.relative_error)
                               : result.warning)
              << "; W_h = 2.125: "
              << (above.error ? std::to_string(*above.error) : std::string("none")) << '\n';
  };
  scene::Scene scene;
  scene.supports = {support("0", true)};
  scene.loads.resize(1);
  print("traction", scene);
  scene.loads[0].type = scene::LoadType::temperature;
  print("temperature", scene);
  scene.loads.resize(2);
  print("temperature and traction", scene);
  scene.loads.resize(1);
  scene.supports = {support("0.1", true)};
  print("temperature, moved", scene);
  scene.loads[0].type = scene::LoadType::gravity;
  print("gravity, moved", scene);
}

int
main()
{
  strain_energies();
  show("loads", 4., 3.75, Drive::loads);
  show("displacement", 4., 4.25, Drive::displacement);
  show("exact", 4., 4., Drive::loads);
  // 4e-9 too much, as rounding of a known value or of a solve leaves.
  show("wrong sign by rounding", 4., 4. + 4e-9, Drive::loads);
  show("contradiction, loads", 4., 4.25, Drive::loads);
  show("contradiction, displacement", 4., 3.75, Drive::displacement);
  show("both", 4., 3.75, Drive::both);
  show("not a number", 4., std::stod("nan"), Drive::loads);

  std::cout << "effectivity " << *estimate::effectivity(0.45, 0.5) << "; unknown "
            << estimate::effectivity(0.45, std::nullopt).has_value()
            << estimate::effectivity(std::nullopt, 0.5).has_value()
            << estimate::effectivity(0.45, 0.).has_value() << '\n';
  drives();
}
