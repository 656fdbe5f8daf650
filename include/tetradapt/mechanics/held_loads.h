// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_held_loads_h
#define tetradapt_mechanics_held_loads_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

#include <set>
#include <string>
#include <vector>

namespace tetradapt::mechanics
{
  /**
   * How much of the area that a load acts on is held by supports. Where a displacement component
   * is prescribed, the load's force along it goes into the support and deforms nothing.
   */
  struct HeldLoad
  {
    std::string           name;             ///< "Loads/tip"
    double                area        = 0.; ///< that it acts on
    double                held_area   = 0.; ///< of it: every component of the load is prescribed
    double                partly_area = 0.; ///< of it: some components of the load are, not all
    std::set<std::string> supports;         ///< that hold it, "Supports/foot"
  };

  /**
   * Looks at each load on faces of @p scene, whose selections are on the patches of @p mesh.
   * Components of a traction that are the constant zero do not count; a pressure has the
   * components of the normal.
   * @return those loads of which a part is held, in the scene's order.
   */
  std::vector<HeldLoad>
  held_loads(const scene::Scene &scene, const mesh::TetMesh &mesh);

  /** What to tell the user about held_loads(), "Loads/tip: ...". */
  std::vector<std::string>
  held_load_warnings(const scene::Scene &scene, const mesh::TetMesh &mesh);
} // namespace tetradapt::mechanics

#endif
