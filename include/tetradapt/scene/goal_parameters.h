// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_goal_parameters_h
#define tetradapt_scene_goal_parameters_h

#include "tetradapt/scene/model_parameters.h"

#include <deal.II/base/point.h>

#include <optional>

namespace tetradapt::scene
{
  enum class GoalType
  {
    point_displacement, ///< u_c at a point
    mean_displacement,  ///< int_G w u_c / int_G w on selected faces
    point_stress,       ///< mean of s_c over a ball, with the kernel (1 - r^2/R^2)^2
    mean_stress,        ///< int w s_c / int w over the body
    functional          ///< int (f.u + S:s) over the body + int_G t.u on selected faces
  };

  /**
   * A linear functional of the displacement that the user wants to know: it is
   * evaluated in every cycle, and the estimator ErrorEstimator::goal estimates its
   * error.
   */
  struct GoalParameters
  {
    std::string      name;
    GoalType         type = GoalType::point_displacement;
    dealii::Point<3> point{0., 0., 0.};
    double           radius    = 0.;  ///< point_stress: R
    std::string      component = "x"; ///< x, y, z; for stresses xx, yy, zz, xy, yz, zx
    std::string      weight    = "1"; ///< means: w, an expression in x, y, z, not negative
    /** mean_displacement, functional: the faces; only the face part is used. */
    Selector                   selector;
    std::array<std::string, 3> displacement_weight; ///< functional: f; empty: none
    std::array<std::string, 3> traction_weight;     ///< functional: t; empty: none
    std::array<std::string, 6> stress_weight; ///< functional: S as xx, yy, zz, xy, yz, zx, each
                                              ///< off-diagonal one counted once: S:s = sum S_i s_i
    std::optional<double> exact;              ///< known value

    bool
    is_stress() const
    {
      return type == GoalType::point_stress || type == GoalType::mean_stress;
    }
    bool
    uses_faces() const
    {
      return type == GoalType::mean_displacement
             || (type == GoalType::functional && !traction_weight[0].empty());
    }
    /** 0..2, or for stresses 0..5 in the order xx, yy, zz, xy, yz, zx. */
    unsigned int
    component_index() const;

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };
} // namespace tetradapt::scene

#endif
