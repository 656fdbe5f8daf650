// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_mechanics_stiffness_points_h
#define tetradapt_source_mechanics_stiffness_points_h

#include "tetradapt/mesh/nodal_field.h"

namespace tetradapt::mechanics
{
  /** Barycentric points of the rule with which stiffness is integrated, all of equal weight:
   * one for degree 1; for degree 2 four, exact to degree 2 (Hammer and Stroud 1956), of
   * which point i lies nearest to vertex i. */
  inline std::vector<mesh::Barycentric>
  stiffness_points(const unsigned int degree)
  {
    if (degree == 1)
      return {{{0.25, 0.25, 0.25, 0.25}}};
    constexpr double               a = 0.58541019662496845446, b = 0.13819660112501051518;
    std::vector<mesh::Barycentric> points(4, {{b, b, b, b}});
    for (unsigned int i = 0; i < 4; ++i)
      points[i][i] = a;
    return points;
  }
} // namespace tetradapt::mechanics

#endif
