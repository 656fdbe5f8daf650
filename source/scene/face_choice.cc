// SPDX-License-Identifier: AGPL-3.0-or-later
#include "face_choice.h"

#include "binder.h"
#include "require.h"

#include "tetradapt/core/condition.h"

namespace tetradapt::scene
{
  void
  bind_where(Selector &selector, Binder &binder)
  {
    binder("Where",
           selector.where,
           text_codec("a condition in x, y, z, or nothing"),
           "Condition in x, y, z that must also hold, such as x < 1e-9: comparisons and "
           "box(x0,y0,z0, x1,y1,z1), sphere(x,y,z, r), cylinder(x0,y0,z0, x1,y1,z1, r), "
           "half_space(x,y,z, nx,ny,nz), combined by &&, || and !; or everywhere: the whole "
           "boundary. Its border is cut into the surface of a box, blocks or a surface file; faces "
           "of other meshes are selected as a whole, if it holds at their corners and centre.");
  }

  void
  check_faces(const Selector &selector, const std::string &path)
  {
    require(!selector.empty(),
            path,
            "it does not say on which faces it acts. Set Where, Groups or Boundary ids, or "
            "Where = everywhere for the whole boundary.");
    if (selector.where.empty())
      return;
    const core::Condition condition(selector.where, path + "/Where");
    require(!condition.is_constant() || condition.holds(core::Point<3>()),
            path + "/Where",
            "'" + selector.where + "' holds nowhere. Give a condition such as x < 1e-9.");
  }
} // namespace tetradapt::scene
