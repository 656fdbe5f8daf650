// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_tractions_h
#define tetradapt_estimate_equilibrated_tractions_h

#include "cells.h"
#include "faces.h"
#include "loads.h"
#include "star.h"

#include "tetradapt/compare/parallel.h"

namespace tetradapt::estimate
{
  /**
   * Tractions on the faces of a mesh that are in equilibrium with the loads on every
   * cell, as a body of its own, made from a Galerkin solution by the method of
   * Ladeveze and Leguillon (SIAM J. Numer. Anal. 20, 1983).
   *
   * For every function phi of the solution's space, hence for every vertex (and
   * every edge, for degree 2), and every component, the moments of the tractions
   * against phi are to fulfil on each cell K around it
   *   sum_F int_F t_K . phi = int_K (stress_h : grad phi - f . phi).
   * These conditions are compatible because of Galerkin's. Where there is a choice,
   * the moments nearest to those of a mean of the stresses of the two sides are taken;
   * the mean is weighted with compliance, as it is the softer side that
   * knows the traction. As rigid motions are sums of the phi, each cell is in
   * equilibrium.
   */
  class FaceTractions
  {
  public:
    /** Computes the tractions on the faces of the cells in @p own, for which the cells
     * around are looked at. The arguments must outlive this object.
     * @throws core::InputError if a force passes between parts of the body that
     *         touch in a point or an edge only. */
    FaceTractions(const mesh::NodalField      &u_h,
                  const CellStates            &states,
                  const CellFaces             &faces,
                  const std::vector<FaceLoad> &loads,
                  const compare::Slice        &own);

    /** Integrals over each face of the traction times the six functions of its
     * corners that EquilibratedElement::n_moments names: 18 numbers a face. The
     * traction is the one that the first cell feels. */
    std::vector<double> moments;

  private:
    void
    find_cells(const compare::Slice &own);
    void
    set_targets(const CellStates &states);
    void
    set_given_tractions();
    void
    balance(bool edges);
    void
    balance_star(const unsigned int *begin, const unsigned int *end);
    Point<3>
    center_of(unsigned int entry) const;
    void
    connect_star(const unsigned int *begin, const unsigned int *end, unsigned int component);
    void
    change_functions();

    const mesh::NodalField      &u_h;
    const mesh::TetMesh         &mesh;
    const CellFaces             &faces;
    const std::vector<FaceLoad> &loads;
    unsigned int                 n_functions; ///< 4 or 10
    std::vector<char>            wanted_points, wanted_cells;
    std::vector<Tensor<1, 3>>    unbalanced; ///< n_functions a cell
    double                       largest_unbalanced = 0.;
    std::vector<double>          conductance; ///< of a face

    struct Way
    {
      unsigned int face, function;
      double       sign;
    };
    StarFlow                  flow;
    std::vector<unsigned int> first_cell; ///< of a face in the star; or none
    std::vector<Way>          ways;
  };
} // namespace tetradapt::estimate

#endif
