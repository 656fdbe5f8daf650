// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The directions in which supports hold a node: those that depend on others, those that nearly do,
// which are told as conflicts, and those of their own.

#include "tetradapt/mechanics/held_directions.h"

#include "bodies.h"

using namespace bodies;

int
main()
{
  Tensor<1, 3> x;
  x[0] = 1.;
  for (const double angle : {1e-9, 1e-4, 1e-2, 0.5})
    {
      mechanics::HeldDirections held;
      held.add(x, 0.1, 0);
      Tensor<1, 3> tilted;
      tilted[0]           = std::cos(angle);
      tilted[1]           = std::sin(angle);
      const auto conflict = held.add(tilted, 0.1 * tilted[0], 1);
      std::cout << "angle " << angle << ": directions " << held.rank() << ", conflict "
                << conflict.has_value() << '\n';
      if (conflict)
        check("  sine", conflict->sine, std::sin(angle), 1., 1e-12);
      check("  value", held.value()[0], 0.1, 1., 1e-12);
      check("  across", held.value()[1], 0., 1., 1e-12);
    }
  mechanics::HeldDirections held;
  held.add(x, 0.1, 3);
  const auto conflict = held.add(x, 0.2, 4);
  check("another value of the same is a conflict", conflict && conflict->sine == 0.);
  check("  with whom", conflict && conflict->owner == 3 && conflict->value == 0.1);
}
