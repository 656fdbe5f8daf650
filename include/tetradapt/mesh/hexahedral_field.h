// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_hexahedral_field_h
#define tetradapt_mesh_hexahedral_field_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace tetradapt::mesh
{
  using dealii::Point;
  using dealii::Tensor;

  /** Positions in [0,1] of the degree + 1 nodes along an edge, those of Gauss and
   * Lobatto: equidistant for degree 1 and 2. */
  std::vector<double>
  hexahedral_nodes(unsigned int degree);

  /** Values and derivatives on [0,1] of the degree + 1 Lagrange polynomials to
   * hexahedral_nodes() at @p x. degree is 1, 2 or 3. */
  void
  lagrange(unsigned int degree, double x, double *values, double *derivatives);

  /**
   * A continuous vector field (a displacement) of degree 2 or 3 in each variable on
   * axis-parallel boxes: the bricks of a tensor grid, each cut into eight any number
   * of times (an octree). Plain data and plain arithmetic: every MPI rank holds all
   * of it.
   */
  class HexahedralField
  {
  public:
    static constexpr unsigned int max_nodes = 64; ///< of a cell

    struct Cell
    {
      Point<3>     lower;
      Tensor<1, 3> size;       ///< edge lengths
      int          region = 0; ///< region id
    };

    /** Where a point lies: @p unit are the coordinates in [0,1]^3 of the cell. */
    struct Location
    {
      unsigned int cell = 0;
      Point<3>     unit;
      double       distance = 0.; ///< of a point outside from the cell; its unit is the nearest
    };

    HexahedralField() = default;

    /**
     * @param planes of the tensor grid, along each axis, increasing.
     * @param cells each is a brick of the grid or the outcome of cutting one.
     * @param values the displacements at the cells' nodes: (degree + 1)^3 a cell, along
     *        x first.
     * @throws core::NumericalError if the cells do not fit into the grid, overlap, or
     *         leave a part of a brick out.
     */
    HexahedralField(unsigned int                       degree,
                    std::array<std::vector<double>, 3> planes,
                    std::vector<Cell>                  cells,
                    std::vector<Tensor<1, 3>>          values);

    unsigned int
    degree() const
    {
      return polynomial_degree;
    }
    unsigned int
    n_cells() const
    {
      return cell_list.size();
    }
    unsigned int
    nodes_per_cell() const
    {
      return (polynomial_degree + 1) * (polynomial_degree + 1) * (polynomial_degree + 1);
    }
    const std::vector<Cell> &
    cells() const
    {
      return cell_list;
    }
    const std::array<std::vector<double>, 3> &
    planes() const
    {
      return grid_planes;
    }
    const std::vector<Tensor<1, 3>> &
    values() const
    {
      return nodal_values;
    }

    /** The cell that holds @p point, or the nearest one. */
    Location
    locate(const Point<3> &point) const;

    /** Longest edge of the smallest cells that touch the box from @p lower to @p upper;
     * the search ends at the first that is not longer than @p enough. Infinite if there
     * is none. */
    double
    smallest_size(const Point<3> &lower, const Point<3> &upper, double enough) const;

    Tensor<1, 3>
    value(unsigned int cell, const Point<3> &unit) const;

    /** du_i/dx_j. */
    Tensor<2, 3>
    gradient(unsigned int cell, const Point<3> &unit) const
    {
      return evaluate(cell, unit).second;
    }

    /** Both at once. */
    std::pair<Tensor<1, 3>, Tensor<2, 3>>
    evaluate(unsigned int cell, const Point<3> &unit) const;

  private:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /** A node of an octree: a cell, or the first of eight consecutive children. */
    struct TreeNode
    {
      unsigned int cell = none, children = none;
    };

    void
    build_trees();
    Location
    locate_in_brick(unsigned int brick, const Point<3> &point) const;
    unsigned int
    nearest_brick(const Point<3> &point) const;
    /** Lower corner (0) and upper corner (1) of a brick. */
    std::array<Point<3>, 2>
    brick_box(unsigned int brick) const;
    double
    smallest_in(unsigned int    node,
                const Point<3> &node_lower,
                const Point<3> &node_upper,
                const Point<3> &lower,
                const Point<3> &upper,
                double          enough) const;

    unsigned int                       polynomial_degree = 2;
    std::array<std::vector<double>, 3> grid_planes;
    std::vector<Cell>                  cell_list;
    std::vector<Tensor<1, 3>>          nodal_values;
    std::vector<TreeNode>              tree; ///< the bricks' roots first
  };
} // namespace tetradapt::mesh

#endif
