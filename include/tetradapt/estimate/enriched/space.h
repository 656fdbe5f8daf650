// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_enriched_space_h
#define tetradapt_estimate_enriched_space_h

#include "tetradapt/estimate/hierarchical_surplus.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mechanics/spring_matrix.h"

#include <deal.II/lac/vector.h>

#include <mpi.h>

#include <optional>

namespace tetradapt::estimate
{
  /**
   * The continuous displacements of degree p + 1 on the mesh of a field of degree p, in
   * the hierarchical basis: first the nodal values of degree p, then the coefficients of
   * the HierarchicalSurplus, three components each. Elements of it, and forces on it,
   * are plain vectors that every rank holds whole.
   *
   * The stiffness is never assembled: cells are worked on in batches of eight, with
   * Bernstein polynomials, whose gradients are sparse and whose products are integrated
   * exactly.
   */
  class EnrichedSpace
  {
  public:
    using Values = dealii::Vector<double>;

    /** For the space of @p field. Reads the tangents at rest of @p materials.
     * @param springs on its mesh, to be kept; null: none. */
    EnrichedSpace(const mesh::NodalField       &field,
                  const mechanics::MaterialMap &materials,
                  MPI_Comm                      communicator,
                  const mechanics::Springs     *springs = nullptr);
    ~EnrichedSpace();

    const HierarchicalSurplus &
    surplus() const
    {
      return hierarchical_surplus;
    }
    unsigned int
    n_nodes() const
    {
      return n_field_nodes;
    }
    /** Nodes and functions of the surplus. */
    unsigned int
    n_functions() const
    {
      return n_field_nodes + hierarchical_surplus.n_functions();
    }
    /** Length of vectors. */
    std::size_t
    size() const
    {
      return 3 * static_cast<std::size_t>(n_functions());
    }
    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }

    /** A field of degree p on the same mesh as an element of this space. */
    Values
    embed(const std::vector<Tensor<1, 3>> &nodal_values) const;

    /** forces_i = a(x, phi_i) for all functions, whether supported or not, springs included.
     * Collective. */
    void
    multiply(const Values &x, Values &forces) const;

    /** a_K(x, y), the energy product of the body on every cell. Collective. */
    std::vector<double>
    cell_products(const Values &x, const Values &y) const;

    /** Adds the products of the springs, int x . K y, to those of the cells that have them. */
    void
    add_spring_products(const Values &x, const Values &y, std::vector<double> &products) const;

    /** The forces int phi_i . K u0 of the ground under the springs. */
    Values
    ground_forces() const;

    /** The matrix of the springs; null: none. */
    const mechanics::SpringMatrix<double> *
    spring_matrix() const
    {
      return springs_matrix ? &*springs_matrix : nullptr;
    }

    /** a(psi, psi) of every function of the surplus, springs included: 3x3 blocks of components,
     * row by row. Collective. */
    std::vector<double>
    surplus_diagonal() const;

  private:
    struct Batches;

    /** The numbers of the functions on a boundary face, and their values there. */
    mechanics::FaceFunctions
    face_functions() const;

    const mechanics::Springs                      *springs; ///< null: none
    MPI_Comm                                       mpi_communicator;
    HierarchicalSurplus                            hierarchical_surplus;
    unsigned int                                   n_field_nodes;
    std::unique_ptr<Batches>                       batches; ///< of the cells of this rank's slice
    std::vector<std::array<unsigned int, 6>>       face_nodes; ///< where there are springs
    std::optional<mechanics::SpringMatrix<double>> springs_matrix;
  };
} // namespace tetradapt::estimate

#endif
