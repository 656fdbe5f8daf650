// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_averaged_stress_h
#define tetradapt_estimate_recovery_averaged_stress_h

#include "tetradapt/estimate/cell_stress.h"
#include "tetradapt/estimate/given_loads.h"

#include <mpi.h>

namespace tetradapt::estimate
{
  /**
   * The stress of Zienkiewicz and Zhu (IJNME 24, 1987): at every node the mean of the
   * stresses of the cells around it, weighted with their volumes, and between the nodes
   * the shape functions of the displacement. A node on an interface of regions has one
   * mean for each.
   *
   * On the boundary the mean is corrected to fit what loads and supports say of the
   * faces around the node: the nearest stress to it in the energy norm, with the
   * squares of StressConditions added.
   */
  class AveragedStress
  {
  public:
    /** @param loads null: nothing is known of the boundary. Not collective: every rank
     *         computes all of it, which costs less than to send it. */
    AveragedStress(const mesh::NodalField &u_h, const CellStress &stress, const GivenLoads *loads);

    /** The stress at a point of @p cell. */
    void
    at(const unsigned int cell, const mesh::Barycentric &b, double *stress) const
    {
      double shape[10];
      mesh::shape_values(n_per_cell == 4 ? 1 : 2, b, shape);
      std::fill(stress, stress + 6, 0.);
      const unsigned int *nodes = &slots[std::size_t(cell) * n_per_cell];
      for (unsigned int i = 0; i < n_per_cell; ++i)
        for (unsigned int c = 0; c < 6; ++c)
          stress[c] += shape[i] * means[6 * std::size_t(nodes[i]) + c];
    }

  private:
    void
    number_slots(const mesh::NodalField &u_h);
    void
    correct_boundary(const mesh::NodalField &u_h,
                     const CellStress       &stress,
                     const GivenLoads       &loads);

    unsigned int              n_per_cell; ///< nodes
    unsigned int              n_slots = 0;
    std::vector<unsigned int> slots; ///< per cell and node: which mean it has
    std::vector<double>       means; ///< six numbers each
  };
} // namespace tetradapt::estimate

#endif
