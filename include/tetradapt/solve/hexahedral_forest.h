// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_forest_h
#define tetradapt_solve_hexahedral_forest_h

#include "tetradapt/solve/hexahedral_grid.h"

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace tetradapt::solve
{
  using dealii::Tensor;
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** A cell that this rank owns. */
  struct HexahedralCell
  {
    Point<3>      lower;
    Tensor<1, 3>  size;      ///< edge lengths
    unsigned int  brick = 0; ///< of the grid
    unsigned int  level = 0; ///< how often the brick was cut
    unsigned char outer = 0; ///< bit s is set: side s is on the boundary

    Point<3>
    at(const Point<3> &unit) const
    {
      return {lower[0] + unit[0] * size[0],
              lower[1] + unit[1] * size[1],
              lower[2] + unit[2] * size[2]};
    }
  };

  /**
   * The nodes of the continuous functions of one degree on the cells of a forest, as
   * plain numbers. A node that this rank knows has a local number: first come those
   * that it owns, then ghosts. Component c of local node n is element 3 n + c of a
   * vector. Nodes in the middle of a larger neighbour's face or edge ("hanging") have
   * no number: their value is a mean of others with given weights.
   */
  struct HexahedralSpace
  {
    unsigned int  degree         = 2;
    unsigned int  nodes_per_cell = 27;
    unsigned int  n_owned        = 0; ///< nodes
    unsigned int  n_local        = 0; ///< with ghosts
    unsigned long n_nodes        = 0; ///< over all ranks
    /** The nodes of each own cell, along x first. Numbers from n_local on are hanging
     * ones: n_local + their place in hanging_begin. */
    std::vector<unsigned int> cell_nodes;
    std::vector<unsigned int> hanging_begin; ///< one more than hanging nodes
    std::vector<unsigned int> parents;       ///< local nodes
    std::vector<double>       weights;       ///< of the parents

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout; ///< of vectors

    const unsigned int *
    nodes(unsigned int cell) const
    {
      return cell_nodes.data() + std::size_t(cell) * nodes_per_cell;
    }
    /** Calls function(local node, weight) for the nodes that make up node @p n. */
    template <typename Function>
    void
    expand(unsigned int n, const Function &function) const
    {
      if (n < n_local)
        return function(n, 1.);
      for (unsigned int k = hanging_begin[n - n_local]; k < hanging_begin[n - n_local + 1]; ++k)
        function(parents[k], weights[k]);
    }
    /** The value at node @p n of a field. */
    Tensor<1, 3>
    value(const Vector &field, unsigned int n) const
    {
      Tensor<1, 3> sum;
      expand(n, [&](unsigned int k, double weight) {
        for (unsigned int c = 0; c < 3; ++c)
          sum[c] += weight * field.local_element(3 * k + c);
      });
      return sum;
    }
    /** Adds to a field of forces what acts on node @p n. */
    void
    add(Vector &field, unsigned int n, const Tensor<1, 3> &force) const
    {
      expand(n, [&](unsigned int k, double weight) {
        for (unsigned int c = 0; c < 3; ++c)
          field.local_element(3 * k + c) += weight * force[c];
      });
    }
  };

  /**
   * A forest of octrees, one in each brick of a grid, distributed over the ranks
   * (deal.II's parallel::distributed::Triangulation on p4est). Neighbours differ by
   * one level at most.
   */
  class HexahedralForest
  {
  public:
    /** The bricks themselves. Keeps a reference to @p grid. Collective. */
    HexahedralForest(const HexahedralGrid &grid, MPI_Comm communicator);
    ~HexahedralForest();

    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }
    const HexahedralGrid &
    grid() const
    {
      return hexahedral_grid;
    }
    /** The own cells, along a curve through space. */
    const std::vector<HexahedralCell> &
    cells() const
    {
      return cell_list;
    }
    /** Over all ranks. */
    unsigned long
    n_cells() const;

    /** Cuts the cells with a true entry, and others where neighbours would differ too
     * much. Cells may move to other ranks. Collective. */
    void
    refine(const std::vector<bool> &flags);

    /** Numbers the nodes of degree 1, 2 or 3. Collective. */
    HexahedralSpace
    number(unsigned int degree) const;

  private:
    void
    list_cells();

    struct Data;
    const HexahedralGrid       &hexahedral_grid;
    MPI_Comm                    mpi_communicator;
    std::unique_ptr<Data>       data;
    std::vector<HexahedralCell> cell_list;
  };
} // namespace tetradapt::solve

#endif
